// Reads `extra_of` and `extras`, which a pass binds.
uint extras_at(uint pixel) { return at.has_extras != 0u ? extra_of[pixel] : 0u; }
uint rim_of(uint word) { return word >> 2u; }
uint hidden_of(uint word) { return (word >> 2u) + (word & kRim); }
Extra extra(uint number) {
    const vec4 said = extras[2u * number + 1u];
    return Extra(extras[2u * number], said.x, said.y < 0, Mix(int(said.z), said.w));
}
