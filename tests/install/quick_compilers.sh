#!/bin/sh
# quick_compilers.sh <directory> - writes compilers cc and c++ there that do not optimize, which is half of the time of a build.
# For tests that ask whether Karma builds, installs and links. To be put at the head of PATH. What is compiled twice from one
# place with the same options, such as for static and shared libraries, is taken from a cache there, if ccache is installed.
set -eu
for name in cc c++; do
    real=$(command -v "$name")
    cached=$(command -v ccache || true)
    printf '#!/bin/sh\nexport CCACHE_DIR="%s"\nexec %s "%s" "$@" -O0\n' "$1/cache" "$cached" "$real" >"$1/$name"
    chmod +x "$1/$name"
done
