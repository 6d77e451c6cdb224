#!/bin/sh
# check_install.sh <source> <build> single|double <0|1: viewer> - installs the build into a scratch prefix, and builds and
# runs the consumer against it, through find_package and through pkg-config. In single precision together with the core
# libraries in double precision: both from one prefix, and, which must fail to link, mixed.
set -eu
source=$1 build=$2 precision=$3 viewer=$4
consumer=$source/tests/install/consumer
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/prefix

precisions=$precision
[ "$precision" = single ] && precisions="single double"

quietly() { # shows the output of a command only when it fails
    "$@" >"$scratch/log" 2>&1 || {
        cat "$scratch/log"
        echo "FAILED: $*"
        exit 1
    }
}

quietly cmake --install "$build" --prefix "$prefix"
mkdir "$scratch/quick"
quietly sh "$source/tests/install/quick_compilers.sh" "$scratch/quick"
if [ "$precision" = single ]; then
    quietly env PATH="$scratch/quick:$PATH" cmake -S "$source" -B "$scratch/other" -DKARMA_PRECISION=double \
        -DKARMA_TESTS=OFF -DKARMA_VIEWER=OFF
    quietly cmake --build "$scratch/other" -j 2
    quietly cmake --install "$scratch/other" --prefix "$prefix"
fi

echo "how Karma was built is nothing to programs"
if grep -rE 'KARMA_(CHECK|ASSERT|VALIDATE)' $(find "$prefix" -name cmake -o -name pkgconfig); then
    echo "FAILED: the package hands macros of its own build to programs"
    exit 1
fi

echo "find_package"
quietly cmake -S "$consumer" -B "$scratch/consumer" -DCMAKE_PREFIX_PATH="$prefix" \
    "-DCONSUMER_COMPONENTS=$(echo $precisions | tr ' ' ';')" -DCONSUMER_PRECISION="$precision" -DCONSUMER_VIEWER="$viewer"
quietly cmake --build "$scratch/consumer"
for program in "$scratch"/consumer/consumer*; do
    [ -x "$program" ] && [ -f "$program" ] && quietly "$program"
done

echo "pkg-config"
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name 'karma-mdt*.pc' | head -n 1)")
export PKG_CONFIG_PATH
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH")
export LD_LIBRARY_PATH
for p in $precisions; do
    suffix=
    [ $p = double ] && suffix=-double
    quietly cc -std=c11 -Wall -Werror "$consumer/consumer.c" -o "$scratch/by-pkgconfig-$p" \
        $(pkg-config --cflags --libs karma-mdt$suffix karma-mcd$suffix)
    quietly "$scratch/by-pkgconfig-$p"
    quietly cc -std=c11 -Wall -Werror "$consumer/boxes.c" -o "$scratch/boxes-$p" \
        $(pkg-config --cflags --libs karma-mst$suffix) -lm
    quietly "$scratch/boxes-$p"
done
suffix=
[ "$precision" = double ] && suffix=-double
if [ "$viewer" = 1 ]; then
    quietly cc -std=c11 -Wall -Werror -DCONSUMER_VIEWER "$consumer/consumer.c" -o "$scratch/with-viewer" \
        $(pkg-config --cflags --libs karma$suffix)
    quietly "$scratch/with-viewer"
fi

[ "$precision" = single ] || exit 0
echo "a mixture of precisions does not link"
if cc -std=c11 $(pkg-config --cflags karma-mdt karma-mcd) "$consumer/consumer.c" -o "$scratch/mixed" \
    $(pkg-config --libs karma-mdt-double karma-mcd-double) >"$scratch/log" 2>&1; then
    echo "FAILED: a single-precision program links with double-precision libraries"
    exit 1
fi
grep -q MeGlobalsIsSinglePrecision "$scratch/log" || {
    cat "$scratch/log"
    echo "FAILED: the linker does not name the precision"
    exit 1
}
echo "installed Karma serves programs outside the tree"
