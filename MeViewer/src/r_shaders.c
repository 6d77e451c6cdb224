/* The shaders. Light is computed and added up linearly; rProgramResolve turns it into what a screen shows. */
#include "r_draw_i.h"

#define VERSION "#version 330 core\n"

/* RFrameBlock */
static const char frame[] = "layout(std140) uniform Frame {\n"
                            "    mat4 viewProjection, shadow;\n"
                            "    vec4 eye, back, right, up, viewport;\n"
                            "    vec4 sky, bounce;\n"
                            "    vec4 keyDirection, keyColor, keySpecular;\n"
                            "    vec4 fillDirection, fillColor, fillSpecular;\n"
                            "    vec4 pointPosition, pointColor, pointSpecular, pointAttenuation;\n"
                            "    vec4 shadowSettings, occlusion, ground, fade, horizon, zenith, quality;\n"
                            "};\n";

/* ---- Triangles ---- */

static const char instanceVertex[] =
    "layout(location = 0) in vec3 aPosition;\n"
    "layout(location = 1) in vec3 aNormal;\n"
    "layout(location = 2) in vec2 aTexture;\n"
    "layout(location = 3) in vec4 aRow0;\n"
    "layout(location = 4) in vec4 aRow1;\n"
    "layout(location = 5) in vec4 aRow2;\n"
    "layout(location = 6) in vec4 aDiffuse;\n"
    "layout(location = 7) in vec4 aAmbient;\n"
    "layout(location = 8) in vec4 aEmissive;\n"
    "layout(location = 9) in vec4 aSpecular;\n"
    "out vec3 vWorld, vLocal, vNormal;\n"
    "out vec2 vTexture;\n"
    "flat out vec4 vDiffuse, vAmbient, vEmissive, vSpecular;\n"
    "void main() {\n"
    "    vec4 p = vec4(aPosition, 1.0);\n"
    "    vWorld = vec3(dot(aRow0, p), dot(aRow1, p), dot(aRow2, p));\n"
    "    vLocal = aPosition;\n"
    "    /* The cofactors keep normals right under any scale. */\n"
    "    vNormal = vec3(dot(cross(aRow1.xyz, aRow2.xyz), aNormal), dot(cross(aRow2.xyz, aRow0.xyz), aNormal),\n"
    "                   dot(cross(aRow0.xyz, aRow1.xyz), aNormal));\n"
    "    vTexture = aTexture;\n"
    "    vDiffuse = aDiffuse;\n"
    "    vAmbient = aAmbient;\n"
    "    vEmissive = aEmissive;\n"
    "    vSpecular = aSpecular;\n"
    "    gl_Position = viewProjection * vec4(vWorld, 1.0);\n"
    "}\n";

static const char depthVertex[] =
    "layout(location = 0) in vec3 aPosition;\n"
    "layout(location = 3) in vec4 aRow0;\n"
    "layout(location = 4) in vec4 aRow1;\n"
    "layout(location = 5) in vec4 aRow2;\n"
    "uniform mat4 uMatrix;\n"
    "void main() {\n"
    "    vec4 p = vec4(aPosition, 1.0);\n"
    "    gl_Position = uMatrix * vec4(dot(aRow0, p), dot(aRow1, p), dot(aRow2, p), 1.0);\n"
    "}\n";

static const char depthFragment[] = "void main() {\n"
                                    "}\n";

/* ---- Light ---- */

/* How much of the key light arrives: the shadow map, filtered with a tent of 7 texels. The tent's weights are put in
 * pairs, so that 16 bilinear samples are enough. Where the surface's own slope comes nearer to the light, the depth to
 * compare with follows it; where it goes away, following would find shadows in every inner corner. */
static const char shadowFunction[] =
    "uniform sampler2DShadow uShadow;\n"
    "uniform sampler2D uOcclusion;\n"
    "vec4 tent(vec4 x) {\n"
    "    vec4 c = clamp(x / 3.0, -1.0, 1.0);\n"
    "    return mix(0.5 * (1.0 + c) * (1.0 + c), 1.0 - 0.5 * (1.0 - c) * (1.0 - c), step(0.0, c));\n"
    "}\n"
    "void weights(float f, out vec4 weight, out vec4 place) {\n"
    "    vec4 first = vec4(-3.0, -1.0, 1.0, 3.0) - f;\n"
    "    vec4 a = tent(first), b = tent(first + 1.0), c = tent(first + 2.0);\n"
    "    weight = c - a;\n"
    "    place = vec4(-2.5, -0.5, 1.5, 3.5) + (c - b) / max(weight, 1e-4);\n"
    "}\n"
    "float keyShadow(vec3 p, vec3 n) {\n"
    "    vec3 s = (shadow * vec4(p + n * shadowSettings.y, 1.0)).xyz;\n"
    "    vec2 edge = abs(s.xy * 2.0 - 1.0);\n"
    "    float inside = shadowSettings.z * (1.0 - smoothstep(0.9, 0.98, max(edge.x, edge.y)));\n"
    "    vec3 g = mat3(shadow) * n;\n"
    "    float most = 4.0 * sqrt(shadowSettings.w);\n"
    "    vec2 slope = clamp(-g.xy / min(g.z, -1e-6) * shadowSettings.w, -most, most);\n"
    "    vec2 texel = s.xy / shadowSettings.x, corner = floor(texel), f = texel - corner;\n"
    "    vec4 wx, wy, px, py;\n"
    "    weights(f.x, wx, px);\n"
    "    weights(f.y, wy, py);\n"
    "    float sum = 0.0;\n"
    "    for (int j = 0; j < 4; j++) {\n"
    "        for (int i = 0; i < 4; i++) {\n"
    "            vec2 at = (corner + vec2(px[i], py[j])) * shadowSettings.x;\n"
    "            float z = s.z + min(dot(at - s.xy, slope), 0.0);\n"
    "            sum += wx[i] * wy[j] * texture(uShadow, vec3(at, z));\n"
    "        }\n"
    "    }\n"
    "    return s.z < 1.0 ? mix(1.0, sum, inside) : 1.0;\n"
    "}\n"
    "/* How much of the sky a point of the ground sees. */\n"
    "float groundOpenness(vec2 p) {\n"
    "    vec2 at = (p - occlusion.xy) * occlusion.z, edge = abs(at * 2.0 - 1.0);\n"
    "    float inside = occlusion.w * (1.0 - smoothstep(0.9, 1.0, max(edge.x, edge.y)));\n"
    "    return inside > 0.0 ? mix(1.0, texture(uOcclusion, at).r, inside) : 1.0;\n"
    "}\n";

/* EXTRA is defined when there is more than the key light's highlight and the fill light: Mesa's software renderer would
 * compute all of it, needed or not. */
static const char extra[] = "#define EXTRA\n";

static const char lightFunctions[] =
    "vec3 highlight(vec3 n, vec3 v, vec3 l, vec3 color, vec4 own) {\n"
    "    vec3 h = normalize(l + v);\n"
    "    float nh = max(dot(n, h), 1e-4), vh = 1.0 - max(dot(v, h), 0.0);\n"
    "    float fresnel = 0.2 + 4.8 * vh * vh * vh * vh * vh;\n"
    "    return color * max(dot(n, l), 0.0) * (fresnel * pow(nh, 40.0) + own.rgb * pow(nh, max(own.w, 1.0)));\n"
    "}\n"
    "vec3 pointLight(vec3 p, vec3 n, vec3 v, vec3 diffuse, vec4 own) {\n"
    "    vec3 l = pointPosition.xyz - p;\n"
    "    float d = length(l);\n"
    "    l /= max(d, 1e-6);\n"
    "    vec3 c = diffuse * pointColor.rgb * max(dot(n, l), 0.0) + highlight(n, v, l, pointSpecular.rgb, own);\n"
    "    return c / max(dot(pointAttenuation.xyz, vec3(1.0, d, d * d)), 1e-6);\n"
    "}\n"
    "vec3 lit(vec3 p, vec3 n, vec3 v, vec3 ambient, vec3 diffuse, vec4 own) {\n"
    "    /* Close to the ground, what comes back from it is in the shadow of the thing itself. */\n"
    "    float open = mix(1.0, groundOpenness(p.xz), ground.y * clamp(1.0 - (p.y - ground.x) / ground.z, 0.0, 1.0));\n"
    "    vec3 c = ambient * mix(bounce.rgb * open, sky.rgb, 0.5 + 0.5 * n.y);\n"
    "    float grazing = 1.0 - max(dot(n, v), 0.0);\n"
    "    c += 0.10 * grazing * grazing * grazing * grazing * sky.rgb * (0.5 + 0.5 * n.y);\n"
    "    float nl = max(dot(n, keyDirection.xyz), 0.0);\n"
    "    vec3 key = diffuse * keyColor.rgb * nl + highlight(n, v, keyDirection.xyz, keySpecular.rgb, own);\n"
    "    c += key * keyShadow(p, n) * smoothstep(0.0, 0.08, nl);\n"
    "    c += diffuse * fillColor.rgb * max(dot(n, fillDirection.xyz), 0.0);\n"
    "#ifdef EXTRA\n"
    "    c += highlight(n, v, fillDirection.xyz, fillSpecular.rgb, own);\n"
    "    c += pointLight(p, n, v, diffuse, own);\n"
    "#endif\n"
    "    return c;\n"
    "}\n";

static const char linearFunction[] =
    "vec3 toLinear(vec3 c) {\n"
    "    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));\n"
    "}\n";

static const char fragmentInputs[] = "in vec3 vWorld, vLocal, vNormal;\n"
                                     "in vec2 vTexture;\n"
                                     "flat in vec4 vDiffuse, vAmbient, vEmissive, vSpecular;\n"
                                     "out vec4 oColor;\n"
                                     "uniform sampler2D uTexture;\n"
                                     "uniform float uTextured;\n";

static const char solidFragment[] =
    "/* -1 and 1 on the two sides of a plane, filtered over the pixel. */\n"
    "float side(float x) {\n"
    "    return clamp(x / max(0.7 * fwidth(x), 1e-6), -1.0, 1.0);\n"
    "}\n"
    "/* A ball's octants, or the quarters round an axis, in two tones: so rolling is seen. */\n"
    "float markOf(vec3 p, float kind) {\n"
    "    float quarters = side(p.x) * side(p.y);\n"
    "    return kind < 0.05 ? 1.0 : 0.83 + 0.17 * (kind < 0.15 ? quarters * side(p.z) : quarters);\n"
    "}\n"
    "void main() {\n"
    "    vec3 v = normalize(mix(back.xyz, eye.xyz - vWorld, eye.w));\n"
    "    vec3 flatNormal = cross(dFdx(vWorld), dFdy(vWorld));\n"
    "    vec3 n = quality.y > 0.5 || dot(vNormal, vNormal) < 1e-20 ? flatNormal : vNormal;\n"
    "    n = normalize(n);\n"
    "    if (dot(n, v) < 0.0 && !gl_FrontFacing)\n"
    "        n = -n;\n"
    "    vec4 t = uTextured > 0.5 ? texture(uTexture, vTexture) : vec4(1.0);\n"
    "    t.rgb = toLinear(t.rgb) * markOf(vLocal, uTextured + vEmissive.w < 0.5 ? vEmissive.w : 0.0);\n"
    "    vec3 plain = t.rgb * vDiffuse.rgb + vEmissive.rgb;\n"
    "    vec3 c = quality.x > 0.5 && vEmissive.w < 0.5\n"
    "                 ? lit(vWorld, n, v, t.rgb * vAmbient.rgb, t.rgb * vDiffuse.rgb, vSpecular) + vEmissive.rgb\n"
    "                 : plain;\n"
    "    /* Glass shows its edge. */\n"
    "    float edge = 1.0 - abs(dot(n, v));\n"
    "    float alpha = vDiffuse.a < 1.0 ? mix(vDiffuse.a, 1.0, 0.6 * edge * edge * edge) : 1.0;\n"
    "    oColor = vec4(c, alpha * t.a);\n"
    "}\n";

/* The ground's own pattern: vSpecular is half its side, the grid's cell, its look (RGroundLook). */
static const char groundFragment[] =
    "/* Lines of a width (cells) on whole numbers, filtered over the pixel. */\n"
    "float grid(vec2 p, vec2 pixel, float width) {\n"
    "    vec2 shown = clamp(vec2(width), pixel, vec2(0.5));\n"
    "    vec2 away = abs(fract(p - 0.5) - 0.5);\n"
    "    vec2 line = 1.0 - smoothstep(0.5 * shown - 0.75 * pixel, 0.5 * shown + 0.75 * pixel, away);\n"
    "    line *= clamp(width / shown, 0.0, 1.0);\n"
    "    line = mix(line, vec2(width), clamp(2.0 * pixel - 0.6, 0.0, 1.0));\n"
    "    return max(line.x, line.y);\n"
    "}\n"
    "/* 0 and 1 in turn, averaged over the pixel. */\n"
    "float checker(vec2 p, vec2 pixel) {\n"
    "    vec2 w = max(pixel, vec2(1e-4));\n"
    "    vec2 a = 2.0 * abs(fract((p - 0.5 * w) / 2.0) - 0.5), b = 2.0 * abs(fract((p + 0.5 * w) / 2.0) - 0.5);\n"
    "    vec2 i = (a - b) / w;\n"
    "    return 0.5 - 0.5 * i.x * i.y;\n"
    "}\n"
    "float random(vec2 p) {\n"
    "    p = fract(p * vec2(0.1031, 0.1030));\n"
    "    p += dot(p, p.yx + 33.33);\n"
    "    return fract((p.x + p.y) * p.x);\n"
    "}\n"
    "/* Values at whole places, smoothly between; its mean is 0. */\n"
    "float spots(vec2 p) {\n"
    "    vec2 i = floor(p), f = p - i;\n"
    "    f = f * f * (3.0 - 2.0 * f);\n"
    "    float near = mix(random(i), random(i + vec2(1.0, 0.0)), f.x);\n"
    "    float far = mix(random(i + vec2(0.0, 1.0)), random(i + 1.0), f.x);\n"
    "    return mix(near, far, f.y) - 0.5;\n"
    "}\n"
    "/* Earth and grass: what is finer than a pixel is left out. */\n"
    "vec3 earth(vec2 p, vec2 pixel) {\n"
    "    float coarse = spots(0.23 * p + 71.0), sum = 0.0, size = 0.5, most = max(pixel.x, pixel.y);\n"
    "    for (int i = 0; i < 4; i++) {\n"
    "        sum += size * clamp(1.6 - 2.0 * most, 0.0, 1.0) * spots(p);\n"
    "        p = mat2(1.7, 1.3, -1.3, 1.7) * p + 17.0;\n"
    "        most *= 2.1;\n"
    "        size *= 0.6;\n"
    "    }\n"
    "    vec3 tone = mix(vec3(0.36, 0.27, 0.18), vec3(0.27, 0.33, 0.15), smoothstep(-0.15, 0.2, coarse + 0.5 * sum));\n"
    "    return tone * (1.0 + 0.7 * sum);\n"
    "}\n"
    "void main() {\n"
    "    vec2 p = vLocal.xz / vSpecular.y, pixel = fwidth(p);\n"
    "    vec3 base = vDiffuse.rgb;\n"
    "    if (uTextured > 0.5) {\n"
    "        base *= toLinear(texture(uTexture, vTexture).rgb);\n"
    "    } else if (vSpecular.z > 2.5) {\n"
    "        base = earth(p, pixel);\n"
    "    } else if (vSpecular.z > 1.5) {\n"
    "        base *= 0.72;\n"
    "    } else if (vSpecular.z > 0.5) {\n"
    "        base *= mix(0.58, 0.77, checker(p, pixel));\n"
    "    } else {\n"
    "        float thin = 0.30 * grid(p, pixel, 0.025), bold = 0.42 * grid(p / 10.0, pixel / 10.0, 0.005);\n"
    "        base *= 0.74 * (1.0 - max(thin, bold));\n"
    "    }\n"
    "    vec3 n = normalize(vNormal);\n"
    "    vec3 c = base * sky.rgb * (0.5 + 0.5 * n.y) * groundOpenness(vWorld.xz);\n"
    "    c += base * keyColor.rgb * max(dot(n, keyDirection.xyz), 0.0) * keyShadow(vWorld, n);\n"
    "    c += base * fillColor.rgb * max(dot(n, fillDirection.xyz), 0.0);\n"
    "#ifdef EXTRA\n"
    "    c += pointLight(vWorld, n, n, base, vec4(0.0));\n"
    "#endif\n"
    "    c = mix(base, c, quality.x);\n"
    "    vec2 q = abs(vLocal.xz) / vSpecular.x;\n"
    "    float edge = pow(pow(q.x, 6.0) + pow(q.y, 6.0), 1.0 / 6.0);\n"
    "    float away = length(vWorld.xz - fade.xy);\n"
    "    float alpha = vDiffuse.a * (1.0 - smoothstep(0.45, 1.0, edge)) * (1.0 - smoothstep(fade.z, fade.w, away));\n"
    "    /* From below one can look through it. */\n"
    "    vec3 v = mix(back.xyz, eye.xyz - vWorld, eye.w);\n"
    "    oColor = vec4(c, dot(v, vNormal) < 0.0 ? 0.25 * alpha : alpha);\n"
    "}\n";

/* ---- The whole picture ---- */

static const char fullVertex[] = "out vec2 vPlace;\n"
                                 "void main() {\n"
                                 "    vPlace = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
                                 "    gl_Position = vec4(vPlace, 0.0, 1.0);\n"
                                 "}\n";

static const char backgroundFragment[] =
    "in vec2 vPlace;\n"
    "out vec4 oColor;\n"
    "void main() {\n"
    "    vec3 d = normalize(-back.xyz + vPlace.x * right.xyz + vPlace.y * up.xyz);\n"
    "    float height = eye.w > 0.5 ? d.y : 0.3 + 0.3 * vPlace.y;\n"
    "    oColor = vec4(mix(horizon.rgb, zenith.rgb, smoothstep(-0.02, 0.6, height)), 1.0);\n"
    "}\n";

/* How much of the sky the ground sees under things whose undersides are known as heights. A disc at height h covers
 * r^2 / (r^2 + h^2) of it, so a ring covers the difference of two such terms. */
static const char occlusionFragment[] =
    "in vec2 vPlace;\n"
    "out vec4 oColor;\n"
    "uniform sampler2D uBelow;\n"
    "uniform vec2 uSize; /* World: the side of the map; its depth. */\n"
    "float covered(vec2 at, float inner, float outer) {\n"
    "    float h = texture(uBelow, at).r;\n"
    "    if (h >= 0.9999)\n"
    "        return 0.0;\n"
    "    h *= uSize.y;\n"
    "    float a = inner * inner, b = outer * outer;\n"
    "    return b / (b + h * h) - a / max(a + h * h, 1e-12);\n"
    "}\n"
    "void main() {\n"
    "    vec2 at = 0.5 + 0.5 * vPlace;\n"
    "    float texel = uSize.x / float(textureSize(uBelow, 0).x), inner = 0.75 * texel;\n"
    "    float sum = covered(at, 0.0, inner);\n"
    "    float turn = 0.0;\n"
    "    for (int ring = 0; ring < 8; ring++) {\n"
    "        float outer = inner * 1.75, r = sqrt(inner * outer) / uSize.x;\n"
    "        float part = 0.0;\n"
    "        for (int i = 0; i < 10; i++) {\n"
    "            float angle = turn + 0.62831853 * float(i);\n"
    "            part += covered(at + r * vec2(cos(angle), sin(angle)), inner, outer);\n"
    "        }\n"
    "        sum += 0.1 * part;\n"
    "        inner = outer;\n"
    "        turn += 0.2;\n"
    "    }\n"
    "    oColor = vec4(clamp(1.0 - sum, 0.0, 1.0));\n"
    "}\n";

/* From the depth buffer: distances along the line of sight, and places as seen from the eye. Needs perspective. */
static const char depthFunctions[] =
    "uniform sampler2D uDepth;\n"
    "uniform vec2 uProjection; /* The depth on the screen, -1 to 1, is x + y / distance. */\n"
    "float distanceAt(vec2 at) {\n"
    "    return uProjection.y / (2.0 * texture(uDepth, at).r - 1.0 - uProjection.x);\n"
    "}\n"
    "/* Of the middle of a pixel: depth and direction have to belong together. */\n"
    "vec3 placeAt(vec2 at) {\n"
    "    vec2 size = vec2(textureSize(uDepth, 0)), middle = (floor(at * size) + 0.5) / size, p = 2.0 * middle - 1.0;\n"
    "    return distanceAt(middle) * (p.x * right.xyz + p.y * up.xyz - back.xyz);\n"
    "}\n";

/* How open the half space over a surface is: 8 places of the picture round it, which tell how high above the surface
 * they stand, weighted down to 0 at the radius. Four by four pixels look in different directions, which
 * rProgramAmbientMean averages again. */
static const char ambientFragment[] =
    "out vec4 oColor;\n"
    "/* Towards the neighbour that is nearer in depth: not over an edge. */\n"
    "vec3 along(vec3 p, vec2 at, vec2 by) {\n"
    "    vec3 a = placeAt(at + by) - p, b = p - placeAt(at - by);\n"
    "    return dot(a, a) < dot(b, b) ? a : b;\n"
    "}\n"
    "void main() {\n"
    "    vec2 texel = 1.0 / vec2(textureSize(uDepth, 0)), at = (2.0 * floor(gl_FragCoord.xy) + 0.5) * texel;\n"
    "    float t = distanceAt(at);\n"
    "    vec3 p = placeAt(at);\n"
    "    vec3 n = normalize(cross(along(p, at, vec2(texel.x, 0.0)), along(p, at, vec2(0.0, texel.y))));\n"
    "    n *= -sign(dot(n, p));\n"
    "    /* A body's size, but a twelfth of the picture's height at most. */\n"
    "    float radius = min(0.7 * ground.z, 0.166 * length(up.xyz) * t);\n"
    "    vec2 reach = 0.5 * radius / (t * vec2(length(right.xyz), length(up.xyz)));\n"
    "    vec2 pixel = mod(floor(gl_FragCoord.xy), 4.0);\n"
    "    float turn = 0.39269908 * mod(5.0 * pixel.x + 7.0 * pixel.y, 16.0), sum = 0.0;\n"
    "    for (int i = 0; i < 8; i++) {\n"
    "        float angle = turn + 2.3999632 * float(i), part = (float(i) + 0.6) / 8.0;\n"
    "        vec3 q = placeAt(at + part * reach * vec2(cos(angle), sin(angle))) - p;\n"
    "        float square = dot(q, q) + 1e-12;\n"
    "        sum += max(dot(q, n) * inversesqrt(square) - 0.12, 0.0) * max(1.0 - square / (radius * radius), 0.0);\n"
    "    }\n"
    "    float seen = smoothstep(1.0, 4.0, reach.y / texel.y);\n"
    "    oColor = vec4(clamp(1.0 - 0.3 * seen * sum, 0.0, 1.0), t, 0.0, 1.0);\n"
    "}\n";

/* The mean over four by four of its pixels that are about as far away. */
static const char ambientMeanFragment[] =
    "in vec2 vPlace;\n"
    "out vec4 oColor;\n"
    "uniform sampler2D uAmbient;\n"
    "void main() {\n"
    "    vec2 at = 0.5 + 0.5 * vPlace, texel = 1.0 / vec2(textureSize(uAmbient, 0));\n"
    "    float t = texture(uAmbient, at).g, sum = 0.0, all = 0.0;\n"
    "    for (int i = 0; i < 4; i++) {\n"
    "        vec2 a = texture(uAmbient, at + texel * vec2(i % 2 == 0 ? -1.5 : 0.5, i < 2 ? -1.5 : 0.5)).rg;\n"
    "        float weight = max(1.0 - abs(a.g - t) / (0.04 * t), 1e-3);\n"
    "        sum += weight * a.r;\n"
    "        all += weight;\n"
    "    }\n"
    "    oColor = vec4(sum / all);\n"
    "}\n";

/* A soft shoulder for what is too bright, the screen's curve, and a little noise against bands in gradients. */
static const char resolveFragment[] =
    "in vec2 vPlace;\n"
    "out vec4 oColor;\n"
    "uniform sampler2D uTexture, uAmbient;\n"
    "uniform float uHasAmbient;\n"
    "void main() {\n"
    "    vec2 at = 0.5 + 0.5 * vPlace;\n"
    "    vec3 c = max(texture(uTexture, at).rgb, 0.0);\n"
    "    if (uHasAmbient > 0.5)\n"
    "        c *= texture(uAmbient, at).r;\n"
    "    c = mix(c, 0.75 + 0.25 * (1.0 - exp((0.75 - c) / 0.25)), step(0.75, c));\n"
    "    c = mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));\n"
    "    float noise = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));\n"
    "    oColor = vec4(c + (noise - 0.5) / 255.0, 1.0);\n"
    "}\n";

/* ---- Lines: each is a rectangle on the screen ---- */

static const char lineVertex[] =
    "layout(location = 0) in vec3 aStart;\n"
    "layout(location = 1) in vec3 aEnd;\n"
    "layout(location = 2) in vec4 aColor;\n"
    "noperspective out float vAcross;\n"
    "flat out vec4 vColor;\n"
    "void main() {\n"
    "    vec4 a = viewProjection * vec4(aStart, 1.0), b = viewProjection * vec4(aEnd, 1.0);\n"
    "    /* What lies behind the near plane is cut off. */\n"
    "    float na = a.z + a.w, nb = b.z + b.w;\n"
    "    if (na < 0.0 && nb < 0.0) {\n"
    "        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);\n"
    "        return;\n"
    "    }\n"
    "    if (na < 0.0)\n"
    "        a = mix(a, b, na / (na - nb));\n"
    "    else if (nb < 0.0)\n"
    "        b = mix(b, a, nb / (nb - na));\n"
    "    vec2 along = (b.xy / b.w - a.xy / a.w) * viewport.xy;\n"
    "    along = dot(along, along) > 1e-12 ? normalize(along) : vec2(1.0, 0.0);\n"
    "    float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0, half_ = 0.5 * viewport.z + 1.0;\n"
    "    vec4 p = gl_VertexID < 2 ? a : b;\n"
    "    vec2 shift = side * half_ * vec2(-along.y, along.x) + (gl_VertexID < 2 ? -0.5 : 0.5) * viewport.z * along;\n"
    "    vAcross = side * half_;\n"
    "    vColor = aColor;\n"
    "    /* A little nearer than a surface that it lies in. */\n"
    "    gl_Position = vec4(p.xy + 2.0 * shift / viewport.xy * p.w, p.z - 2e-4 * abs(p.w), p.w);\n"
    "}\n";

static const char lineFragment[] =
    "noperspective in float vAcross;\n"
    "flat in vec4 vColor;\n"
    "out vec4 oColor;\n"
    "void main() {\n"
    "    oColor = vec4(toLinear(vColor.rgb), vColor.a * clamp(0.5 * viewport.z + 0.5 - abs(vAcross), 0.0, 1.0));\n"
    "}\n";

/* ---- What is laid over the picture ---- */

static const char overlayVertex[] =
    "layout(location = 0) in vec2 aPlace;\n"
    "layout(location = 1) in vec2 aTexture;\n"
    "layout(location = 2) in vec4 aColor;\n"
    "out vec2 vTexture;\n"
    "out vec4 vColor;\n"
    "void main() {\n"
    "    vTexture = aTexture;\n"
    "    vColor = aColor;\n"
    "    gl_Position = vec4(2.0 * aPlace.x / viewport.w - 1.0, 1.0 - 2.0 * aPlace.y / viewport.y, 0.0, 1.0);\n"
    "}\n";

static const char overlayFragment[] = "in vec2 vTexture;\n"
                                      "in vec4 vColor;\n"
                                      "out vec4 oColor;\n"
                                      "uniform sampler2D uTexture;\n"
                                      "void main() {\n"
                                      "    oColor = vColor * texture(uTexture, vTexture);\n"
                                      "}\n";

/* ---- Put together ---- */

#define PIECES(...)                                                                                                    \
    (const char *const[]) {                                                                                            \
        VERSION, __VA_ARGS__, NULL                                                                                     \
    }

const RProgramSource r_programSources[R_PROGRAMS] = {
    [rProgramBackground] = {PIECES(fullVertex), PIECES(frame, backgroundFragment)},
    [rProgramSolid] = {PIECES(frame, instanceVertex),
                       PIECES(frame, fragmentInputs, linearFunction, shadowFunction, lightFunctions, solidFragment)},
    [rProgramSolidExtra] = {PIECES(frame, instanceVertex), PIECES(extra, frame, fragmentInputs, linearFunction,
                                                                  shadowFunction, lightFunctions, solidFragment)},
    [rProgramGroundExtra] = {PIECES(frame, instanceVertex), PIECES(extra, frame, fragmentInputs, linearFunction,
                                                                   shadowFunction, lightFunctions, groundFragment)},
    [rProgramGround] = {PIECES(frame, instanceVertex),
                        PIECES(frame, fragmentInputs, linearFunction, shadowFunction, lightFunctions, groundFragment)},
    [rProgramDepth] = {PIECES(depthVertex), PIECES(depthFragment)},
    [rProgramOcclusion] = {PIECES(fullVertex), PIECES(occlusionFragment)},
    [rProgramLine] = {PIECES(frame, lineVertex), PIECES(frame, linearFunction, lineFragment)},
    [rProgramAmbient] = {PIECES(fullVertex), PIECES(frame, depthFunctions, ambientFragment)},
    [rProgramAmbientMean] = {PIECES(fullVertex), PIECES(ambientMeanFragment)},
    [rProgramResolve] = {PIECES(fullVertex), PIECES(resolveFragment)},
    [rProgramOverlay] = {PIECES(frame, overlayVertex), PIECES(overlayFragment)},
};
