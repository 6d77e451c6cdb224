/** @file RGeometryUtils.h
 *  Triangles of simple shapes, for programs that fill graphics themselves (User Guide App. B, "Geometry Data Format").
 *
 *  To each shape belong a function that says how many vertices it has, and one that writes them into a graphic with
 *  room for as many (RGraphicCreateEmpty) and sets its m_nNumVertices. Round shapes lie along z; `sides` go round (3
 *  to 1024), `rings` go from end to end (2 to 1024). Bad input gets a MeWarning and leaves the graphic as it was; a
 *  count is then 0.
 */
#ifndef RGEOMETRYUTILS_H
#define RGEOMETRYUTILS_H

#include "MeViewerTypes.h"

ME_BEGIN_C

/** Along x, y and z, round the origin. */
MEPUBLIC int MEAPI RCalculateBoxVertexCount(void);
MEPUBLIC void MEAPI RCalculateBoxGeometry(RGraphic *rg, AcmeReal lx, AcmeReal ly, AcmeReal lz);

/** Round the origin, its poles on the z axis. */
MEPUBLIC int MEAPI RCalculateSphereVertexCount(int sides, int rings);
MEPUBLIC void MEAPI RCalculateSphereGeometry(RGraphic *rg, AcmeReal radius, int sides, int rings);

/** A sphere cut in two, with @a height between the halves. @a rings counts both halves' and is even. */
MEPUBLIC int MEAPI RCalculateSphylVertexCount(int sides, int rings);
MEPUBLIC void MEAPI RCalculateSphylGeometry(RGraphic *rg, AcmeReal radius, AcmeReal height, int sides, int rings);

/** @a bottom and @a top are z coordinates; the apex is at @a top. */
MEPUBLIC int MEAPI RCalculateConeVertexCount(int sides);
MEPUBLIC void MEAPI RCalculateConeGeometry(RGraphic *rg, AcmeReal radius, AcmeReal bottom, AcmeReal top, int sides);

/** A radius may be 0, but not both. Up to 12 sides its sides are flat, with more they are smooth. */
MEPUBLIC int MEAPI RCalculateFrustumVertexCount(int sides);
MEPUBLIC void MEAPI RCalculateFrustumGeometry(RGraphic *rg, AcmeReal bottomRadius, AcmeReal topRadius, AcmeReal bottom,
                                              AcmeReal top, int sides);

/** @a rings go round the tube. */
MEPUBLIC int MEAPI RCalculateTorusVertexCount(int sides, int rings);
MEPUBLIC void MEAPI RCalculateTorusGeometry(RGraphic *rg, AcmeReal outerRadius, AcmeReal innerRadius, int sides,
                                            int rings);

/** The upper half (y > 0) of a sphere seen from inside, its texture repeated @a tileU and @a tileV times. */
MEPUBLIC int MEAPI RCalculateDomeVertexCount(int sides, int rings);
MEPUBLIC void MEAPI RCalculateDomeGeometry(RGraphic *rg, AcmeReal radius, int sides, int rings, int tileU, int tileV);

/** Fills one vertex. */
MEPUBLIC void MEAPI RSetVertex(RObjectVertex *vertex, const MeVector3 vert, const MeVector3 norm, MeReal u, MeReal v);

ME_END_C

#endif
