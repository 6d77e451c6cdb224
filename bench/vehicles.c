/* What cars cost that drive about.
 *
 *     vehicles [--cars N] [--steps N] [--plane] [--triangle M] [--rough M] [--cast ray|sphere|cylinder]
 *
 * 100 cars, 600 steps of 1/60 s, rays. Hills of a mesh of 20 000 triangles, or with legs of M metres, and bumps of that
 * height on them; or a plane. Each car drives in circles of
 * its own, 12 m from the next. A line for every hundred steps: ms a step, mean and median and the worst;
 * wheels on the ground; the mean speed. */
#include "timing.h"

#include "Mst.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STRETCH = 100, MAX_SIDE = 1500, MAX_CARS = 10000 };

typedef struct Options {
    int cars, steps, cast;
    MeBool isPlane;
    double triangle, rough; /* m; triangle 0: a hundred on each side */
} Options;

static MstUniverseID u;
static MstVehicleID car[MAX_CARS];

static double heightAt(double x, double y, int i, int j, double rough) {
    const unsigned noise = ((unsigned)i * 2654435761u) ^ ((unsigned)j * 2246822519u);
    return .6 * sin(x / 4) * cos(y / 5) - .6 + rough * (noise >> 8 & 0xffff) / 0xffff;
}

static McdGeometryID makeHills(const Options *o, double size) {
    static MeVector3 vertex[(MAX_SIDE + 1) * (MAX_SIDE + 1)];
    static int index[6 * MAX_SIDE * MAX_SIDE];
    const int wanted = o->triangle > 0 ? (int)(size / o->triangle) : 100, side = wanted < 2          ? 2
                                                                                 : wanted > MAX_SIDE ? MAX_SIDE
                                                                                                     : wanted;
    int n = 0;
    for (int i = 0; i <= side; i++)
        for (int j = 0; j <= side; j++) {
            const double x = (i - side / 2) * size / side, y = (j - side / 2) * size / side;
            MeVector3Set(vertex[i * (side + 1) + j], (MeReal)x, (MeReal)y, (MeReal)heightAt(x, y, i, j, o->rough));
        }
    for (int i = 0; i < side; i++)
        for (int j = 0; j < side; j++) {
            const int a = i * (side + 1) + j, b = a + side + 1, corner[6] = {a, b, b + 1, a, b + 1, a + 1};
            memcpy(index + n, corner, sizeof corner);
            n += 6;
        }
    return McdMeshCreate(u->frame, (const MeVector3 *)vertex, (side + 1) * (side + 1), index, n / 3, 0);
}

static void addGround(const Options *o, double size) {
    static MeMatrix4 tm = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    MstFixedModelCreate(u, o->isPlane ? McdPlaneCreate(u->frame) : makeHills(o, size), tm);
}

static MstVehicleID addCar(const Options *o, double x, double y) {
    MstVehicleParams params;
    MstWheelParams wheel;
    const McdModelID chassis = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 4, (MeReal)1.6, (MeReal).4), 470);
    McdModelDynamicsSetPosition(chassis, (MeReal)x, (MeReal)y, (MeReal).8);
    MstVehicleSetDefaults(&params, u);
    params.cast = (MstVehicleCast)o->cast;
    const MstVehicleID v = MstVehicleCreate(u, chassis, &params);
    for (int i = 0; i < 4; i++) {
        MstWheelSetDefaults(&wheel, u);
        MeVector3Set(wheel.position, i < 2 ? (MeReal)1.3 : (MeReal)-1.3, i % 2 ? (MeReal)-.75 : (MeReal).75,
                     (MeReal)-.2);
        wheel.axle = i / 2;
        wheel.antiRoll = 8000;
        wheel.steering = i < 2 ? (MeReal).6 : 0;
        wheel.drive = i < 2 ? 0 : 1;
        MstVehicleAddWheel(v, &wheel);
    }
    return v;
}

static void make(const Options *o) {
    const int side = (int)ceil(sqrt(o->cars));
    u = MstUniverseCreate(&MstUniverseGrowingSizes);
    if (!u)
        abort();
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)-9.81);
    addGround(o, 12. * side + 60);
    for (int i = 0; i < o->cars; i++)
        car[i] = addCar(o, 12 * (i % side - (side - 1) / 2.), 12 * (i / side - (side - 1) / 2.));
}

static void steer(const Options *o) {
    for (int i = 0; i < o->cars; i++)
        MstVehicleDrive(car[i], MstVehicleGetSpeed(car[i]) < 4 ? (MeReal).5 : 0, i % 2 ? 1 : -1, 0, 0);
}

static void tell(const Options *o, int to, double times[STRETCH]) {
    double sum = 0, speed = 0;
    int onGround = 0;
    MstWheelState w;
    for (int i = 0; i < STRETCH; i++)
        sum += times[i];
    for (int i = 0; i < o->cars; i++)
        for (int k = 0; k < 4; k++) {
            MstVehicleGetWheel(car[i], k, &w);
            onGround += w.ground != 0;
            speed += (double)MstVehicleGetSpeed(car[i]) / 4 / o->cars;
        }
    const double middle = median(times, STRETCH);
    printf("| %d | %.3f | %.3f | %.3f | %.0f %% | %.1f |\n", to, 1e3 * sum / STRETCH, 1e3 * middle,
           1e3 * times[STRETCH - 1], 25. * onGround / o->cars, speed);
    fflush(stdout);
}

static int castOf(const char *name) {
    return strcmp(name, "sphere") == 0 ? kMstVehicleSphere : strcmp(name, "cylinder") == 0 ? kMstVehicleCylinder : 0;
}

int main(int argc, char **argv) {
    Options o = {100, 600, 0, MEFALSE, 0, 0};
    static double times[STRETCH];
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--plane") == 0)
            o.isPlane = METRUE;
        else if (i + 1 < argc && strcmp(argv[i], "--cars") == 0)
            o.cars = atoi(argv[++i]);
        else if (i + 1 < argc && strcmp(argv[i], "--steps") == 0)
            o.steps = atoi(argv[++i]);
        else if (i + 1 < argc && strcmp(argv[i], "--triangle") == 0)
            o.triangle = atof(argv[++i]);
        else if (i + 1 < argc && strcmp(argv[i], "--rough") == 0)
            o.rough = atof(argv[++i]);
        else if (i + 1 < argc && strcmp(argv[i], "--cast") == 0)
            o.cast = castOf(argv[++i]);
    }
    o.cars = o.cars < 1 ? 1 : o.cars > MAX_CARS ? MAX_CARS : o.cars;
    make(&o);
    printf("| to step | mean ms | median | worst | on ground | m/s |\n|---|---|---|---|---|---|\n");
    for (int i = 1; i <= o.steps; i++) {
        steer(&o);
        const double start = now();
        MstUniverseStep(u, (MeReal)(1. / 60));
        times[(i - 1) % STRETCH] = now() - start;
        if (i % STRETCH == 0)
            tell(&o, i, times);
    }
    MstUniverseDestroy(u);
    return 0;
}
