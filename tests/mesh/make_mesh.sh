# Tests sinew-make-mesh: the output is as promised and repeatable, and the exit codes are as documented.
# Arguments: the program, a folder to write to.
program=$1
folder=$2

expect() { # expect CODE ARGUMENTS...: runs the program
    wanted=$1
    shift
    output=$("$program" "$@" 2>&1)
    found=$?
    if [ "$found" -ne "$wanted" ]; then
        echo "sinew-make-mesh $*: exit code $found, not $wanted: $output"
        exit 1
    fi
}

expect 0 sphere "$folder/a.obj" --resolution 8
[ "$output" = "$folder/a.obj: 66 vertices, 128 triangles" ] || { echo "it says: $output"; exit 1; }
[ "$(grep -c '^v ' "$folder/a.obj") $(grep -c '^f ' "$folder/a.obj")" = "66 128" ] || { echo "a.obj is incomplete"; exit 1; }
expect 0 organ "$folder/a.ply" --resolution 16
expect 0 organ "$folder/b.ply" --resolution 16
cmp "$folder/a.ply" "$folder/b.ply" || exit 1
expect 0 --help
expect 2 teapot "$folder/c.obj"
expect 2 organ "$folder/c.stl"
expect 2 organ "$folder/c.obj" --resolution 7
expect 2 organ
expect 6 organ "$folder/none/c.obj"
[ ! -e "$folder/c.obj" ] || { echo "a refused file was written"; exit 1; }
