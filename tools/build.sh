# How Karma is built by tools/test, run, states and bench, and by hand after `. tools/build.sh`: with Ninja where it is
# installed, on all cores. Presets cannot ask for either. An existing build directory keeps its generator.
if [ -z "${CMAKE_GENERATOR:-}" ] && command -v ninja >/dev/null 2>&1; then
    export CMAKE_GENERATOR=Ninja NINJA_STATUS='[%p] ' # as Makefiles tell it, for progress.sh
fi
CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
export CMAKE_BUILD_PARALLEL_LEVEL
