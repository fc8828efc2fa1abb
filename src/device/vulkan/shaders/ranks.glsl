// Ranks among a group's invocations. The includer defines a group of 256.

shared uint rank_words[8];

// Numbers of invocations with `is_in`: those before this one, and all. Each invocation must call it.
uvec2 ranked(bool is_in) {
    const uint own = gl_LocalInvocationIndex;
    barrier();
    if (own < 8u) rank_words[own] = 0u;
    barrier();
    if (is_in) atomicOr(rank_words[own / 32u], 1u << (own % 32u));
    barrier();
    uvec2 found = uvec2(0);
    for (uint w = 0u; w < 8u; ++w) {
        const uint word = rank_words[w], before = (1u << (own % 32u)) - 1u;
        if (w < own / 32u) found.x += bitCount(word);
        if (w == own / 32u) found.x += bitCount(word & before);
        found.y += bitCount(word);
    }
    return found;
}
