# What tools/run, setup and test say of work that takes minutes. Read by them with '.'; $log is a file of theirs.

# progress TEXT - copies its input, the output of CMake or apt-get, to the end of $log, and tells how far it is: on one
# line that is renewed, or, where output goes into a file, with a line for each of apt-get's stages.
progress() {
    told=
    while IFS= read -r line; do
        printf '%s\n' "$line" >>"$log"
        case $line in
        "["*"%]"*) stage= now="$1: ${line%%]*}]" ;;
        Hit:* | Get:*) stage="$1: fetching" now="$stage ${line#* }" ;;
        "Unpacking "*) stage="$1: unpacking" now="$1: ${line%% (*}" ;;
        "Setting up "*) stage="$1: setting up" now="$1: ${line%% (*}" ;;
        *) continue ;;
        esac
        if [ -t 2 ]; then
            printf '\r\033[K%.79s' "$now" >&2
        elif [ "$stage" != "$told" ]; then
            echo "$stage" >&2
            told=$stage
        fi
    done
    [ ! -t 2 ] || printf '\r\033[K' >&2
}
