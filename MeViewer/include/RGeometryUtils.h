/** @file RGeometryUtils.h
 *  Triangles of simple shapes, for programs that fill graphics themselves.
 *
 *  Each shape has two functions: one returns its number of vertices; the other writes them to a graphic with room for
 *  as many (RGraphicCreateEmpty) and sets its m_nNumVertices. Round shapes have their axis along z, with a number of
 *  `sides` around it (3 to 1024) and of `rings` from end to end (2 to 1024). Bad input gets a MeWarning and leaves the
 *  graphic unchanged; a count is then 0.
 */
#ifndef RGEOMETRYUTILS_H
#define RGEOMETRYUTILS_H

#include "MeViewerTypes.h"

ME_BEGIN_C

/** A box with edges along x, y and z, centred at the origin. */
MEPUBLIC int MEAPI RCalculateBoxVertexCount(void);
/** @a lx, @a ly, @a lz: whole lengths of the edges. */
MEPUBLIC void MEAPI RCalculateBoxGeometry(RGraphic *rg, AcmeReal lx, AcmeReal ly, AcmeReal lz);

/** A sphere about the origin, with its poles on the z axis. */
MEPUBLIC int MEAPI RCalculateSphereVertexCount(int sides, int rings);
/** @a rg must have room for RCalculateSphereVertexCount vertices; so for the others. */
MEPUBLIC void MEAPI RCalculateSphereGeometry(RGraphic *rg, AcmeReal radius, int sides, int rings);

/** A capsule: two hemispheres, @a height apart. @a rings is the even number of rings of both hemispheres. */
MEPUBLIC int MEAPI RCalculateSphylVertexCount(int sides, int rings);
/** @a height: distance of the hemispheres' centres. */
MEPUBLIC void MEAPI RCalculateSphylGeometry(RGraphic *rg, AcmeReal radius, AcmeReal height, int sides, int rings);

/** A cone; @a bottom and @a top are z coordinates, the apex is at @a top. */
MEPUBLIC int MEAPI RCalculateConeVertexCount(int sides);
/** @a radius: at @a bottom. */
MEPUBLIC void MEAPI RCalculateConeGeometry(RGraphic *rg, AcmeReal radius, AcmeReal bottom, AcmeReal top, int sides);

/** A frustum. One radius may be 0, but not both. Shading is flat up to 12 sides, smooth with more. */
MEPUBLIC int MEAPI RCalculateFrustumVertexCount(int sides);
/** @a bottom, @a top: z coordinates. */
MEPUBLIC void MEAPI RCalculateFrustumGeometry(RGraphic *rg, AcmeReal bottomRadius, AcmeReal topRadius, AcmeReal bottom,
                                              AcmeReal top, int sides);

/** A torus; @a rings is the number of sections around the tube. */
MEPUBLIC int MEAPI RCalculateTorusVertexCount(int sides, int rings);
/** @a outerRadius: of the whole; @a innerRadius: of the hole. */
MEPUBLIC void MEAPI RCalculateTorusGeometry(RGraphic *rg, AcmeReal outerRadius, AcmeReal innerRadius, int sides,
                                            int rings);

/** The upper half (y > 0) of a sphere, seen from inside, with its texture repeated @a tileU and @a tileV times. */
MEPUBLIC int MEAPI RCalculateDomeVertexCount(int sides, int rings);
/** @a rings: from the horizon to the zenith. */
MEPUBLIC void MEAPI RCalculateDomeGeometry(RGraphic *rg, AcmeReal radius, int sides, int rings, int tileU, int tileV);

/** Sets all members of a vertex. */
MEPUBLIC void MEAPI RSetVertex(RObjectVertex *vertex, const MeVector3 vert, const MeVector3 norm, MeReal u, MeReal v);

ME_END_C

#endif
