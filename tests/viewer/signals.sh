# Sourced by tests that send signals to programs in the background. Needs `fail`.
# A shell starts what runs in its background with SIGINT ignored, and redirects the output there: a signal that comes before the program has
# handlers of its own is lost, and a file of its output may be that of the program before.
awaitHandlers() { # PROCESS, within a minute
    local caught
    for _ in {1..600}; do
        caught=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$1/status" 2>/dev/null) || fail "it has ended before the signal"
        ((0x${caught:-0} >> 1 & 1)) && return # SIGINT is signal 2
        sleep 0.1
    done
    fail "it catches no signals"
}
endsWithin() { # SECONDS SIGNAL PROCESS: with exit code 130. One that does not end is killed
    local code=0 from
    awaitHandlers "$3"
    from=$(date +%s%N)
    kill -"$2" "$3" || fail "it has ended before SIG$2"
    for _ in {1..600}; do kill -0 "$3" 2>/dev/null || break; sleep 0.1; done
    kill -KILL "$3" 2>/dev/null && fail "SIG$2: it still runs a minute later"
    wait "$3" || code=$?
    (($(date +%s%N) - from < $1 * 1000000000)) || fail "SIG$2 took longer than $1 s"
    [[ $code == 130 ]] || fail "SIG$2: exit code $code, expected 130"
    [[ -z $(find . -name '*.tmp*' -o -name '*.part*' -o -name '.*.png*') ]] || fail "SIG$2: partial files: $(find .)"
}
