// Saves the contact memory of a list with the partners; contacts that do not touch have none. Returns the saved
// range.
uvec2 keep(uvec2 list) {
    uint next = list.x;
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const vec4 one = memory[element];
        if (one == vec4(0.0)) continue;
        kept[next] = one;
        keptOthers[next++] = contacts[element].other;
    }
    return uvec2(list.x, next - list.x);
}
