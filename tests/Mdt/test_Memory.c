/* A warm step allocates nothing, though bodies fall asleep and wake, and joints and contacts come and go. */
#include "scene.h"

static int allocations;

static void *MEAPI create(size_t bytes) {
    allocations++;
    return malloc(bytes ? bytes : 1);
}

static void *MEAPI createAligned(size_t bytes, unsigned int alignment) {
    allocations++;
    return aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

static void *MEAPI resize(void *const block, size_t bytes) {
    allocations++;
    return realloc(block, bytes);
}

static void MEAPI destroy(void *const block) {
    free(block);
}

enum { BODIES = 100, PERIOD = 4, WARM = 20, STEPS = 200 };

/* Bodies in a row that hang on springs; between neighbours joints, and groups of contacts. */
typedef struct Row {
    MdtWorldID world;
    MdtBodyID body[BODIES];
    MdtLinear1ID joint[BODIES];
    MdtContactGroupID group[BODIES];
} Row;

static Row build(void) {
    Row s;
    s.world = scene_open(MeNoLimit, MeNoLimit, 0);
    MdtWorldEnableReport(s.world);
    for (int i = 0; i < BODIES; i++) {
        s.body[i] = scene_body(s.world, 1, i, 0, 0);
        s.joint[i] = MdtLinear1Create(s.world);
        s.group[i] = MdtContactGroupCreate(s.world);
        MdtLinear1SetBodies(s.joint[i], s.body[i], i > 0 ? s.body[i - 1] : 0);
        MdtContactGroupSetBodies(s.group[i], s.body[i], i > 0 ? s.body[i - 1] : 0);
    }
    return s;
}

/* Every fourth joint is off, every step another; and so are contacts, whose number changes. */
static void changeGraph(Row *s, int step) {
    for (int i = 0; i < BODIES; i++) {
        if ((i + step) % PERIOD == 0)
            MdtLinear1Disable(s->joint[i]);
        else
            MdtLinear1Enable(s->joint[i]);
        MdtContactGroupReset(s->group[i]);
        for (int k = 0; k < (i + 2 * step) % PERIOD; k++)
            MdtContactGroupCreateContact(s->group[i]);
        if ((i + step) % PERIOD == 1)
            MdtContactGroupEnable(s->group[i]);
        else
            MdtContactGroupDisable(s->group[i]);
    }
    MdtBodyDisable(s->body[step % BODIES]);
    MdtBodyEnable(s->body[(step + BODIES / 2) % BODIES]);
}

TEST(a_warm_step_allocates_nothing_while_the_graph_changes) {
    const MeMemoryAPIStruct before = MeMemoryAPI;
    MeMemoryAPI = (MeMemoryAPIStruct){create, createAligned, resize, destroy, destroy};
    Row s = build();
    for (int step = 0; step < WARM + STEPS; step++) {
        if (step == WARM) {
            ck_assert_int_gt(allocations, 0);
            allocations = 0;
        }
        changeGraph(&s, step);
        MdtWorldStep(s.world, FRAME);
        ck_assert_msg(step < WARM || allocations == 0, "%d allocations in step %d", allocations, step);
    }
    MdtReport r;
    ck_assert(MdtWorldGetReport(s.world, &r) && r.rows > BODIES / 2);
    MdtWorldDestroy(s.world);
    MeMemoryAPI = before;
}
