# Sourced by tests that send signals to programs in the background. Needs `fail`.
# A shell starts background programs with SIGINT ignored and redirects their output itself. A signal sent
# before the program has handlers is lost, and an output file may still be that of the previous program.
awaitHandlers() { # PROCESS: waits up to a minute for its handlers
    local caught
    for _ in {1..600}; do
        caught=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$1/status" 2>/dev/null) || fail "it has ended before the signal"
        ((0x${caught:-0} >> 1 & 1)) && return # SIGINT is signal 2
        sleep 0.1
    done
    fail "it catches no signals"
}
endsWithin() { # SECONDS SIGNAL PROCESS: sends the signal and expects exit code 130 in time; kills a process that does not end
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
