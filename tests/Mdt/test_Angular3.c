#include "measure.h"
static void tests(TCase *t) {
(void)t;
}
TEST_MAIN("Angular3", tests)
