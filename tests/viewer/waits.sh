# Sourced by tests of the viewer: waits, with a bound, for a command to succeed and for work of a process. Needs `fail`.
# within SECONDS COMMAND...: waits until the command succeeds; fails if it does not in that time. Tries it every `pause`
# tenths of a second: commands that look at pictures take a processor from the viewer.
within() {
    local tries=$((10 * $1 / ${pause:-1}))
    shift
    for ((; tries > 0; --tries)); do "$@" && return; sleep "0.${pause:-1}"; done
    return 1
}
await() { within "$@" || fail "waited in vain for: ${*:2}"; } # SECONDS COMMAND...: the same, and ends the test
isFilming() { [[ -n $(find . -name '*.mp4*.part' -size "+$1") ]]; } # SIZE: more than that is written
used() { # PROCESS...: sets `ticks` to the processor time of the processes [1/100 s], and `isRunning` if a thread runs or waits for a processor
    local process file line
    ticks=0 isRunning=
    for process; do
        for file in "/proc/$process/stat" "/proc/$process"/task/*/stat; do
            { read -r line <"$file"; } 2>/dev/null || continue # it has ended
            line=${line##*) }
            [[ $line == S* ]] || isRunning=yes
            [[ $file == */task/* ]] && continue
            set -- $line
            ticks=$((ticks + ${12} + ${13}))
        done
    done
}
awaitWork() { # PROCESS TICKS: waits until it has used so much more processor time [1/100 s], or has ended
    used "$1"
    local until=$((ticks + $2))
    hasWorked() { [[ ! -d /proc/$1 ]] || { used "$1" && ((ticks >= until)); }; }
    await 120 hasWorked "$1"
}
