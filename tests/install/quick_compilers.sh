#!/bin/sh
# quick_compilers.sh <directory> - writes compilers cc and c++ there that neither optimize nor warn, which is half of the
# time of a build. For tests that ask whether Karma builds, installs and links. To be put at the head of PATH. What is
# compiled twice from one place, such as for static and shared libraries and as part of a project, is taken from a cache
# there, if ccache is installed: CMake has the same options in another order where Karma is a part.
set -eu
cached=$(command -v ccache || true)
for name in cc c++; do
    real=$(command -v "$name")
    cat >"$1/$name" <<END
#!/bin/sh
export CCACHE_DIR="$1/cache"
ndebug=
for option; do
    shift
    case \$option in
    -DNDEBUG) ndebug=-DNDEBUG ;;
    -O? | -W[a-km-z]*) ;;
    *) set -- "\$@" "\$option" ;;
    esac
done
exec $cached "$real" "\$@" \$ndebug -O0
END
    chmod +x "$1/$name"
done
