/* Hashes of vertices, fast enough to be taken of every graphic in every frame. */
#include "r_i.h"

#include <string.h>

enum { LANES = 8, WORDS_PER_VERTEX = sizeof(RObjectVertex) / 8, STRIPES_PER_BLOCK = 16 };

static const uint64_t keys[LANES] = {0x9e3779b97f4a7c15u, 0xbf58476d1ce4e5b9u, 0x94d049bb133111ebu,
                                     0xd6e8feb86659fd93u, 0xa0761d6478bd642fu, 0xe7037ed1a0b428dbu,
                                     0x8ebc6af09c88c6e3u, 0x589965cc75374cc3u};

uint64_t r_hashWord(uint64_t hash, uint64_t word) {
    hash = (hash ^ word) * keys[0];
    return hash ^ hash >> 29;
}

/* Eight words at a time, each multiplied half by half: compilers make vector instructions of this. */
static void addStripe(uint64_t lane[LANES], const uint64_t word[LANES]) {
    for (int i = 0; i < LANES; i++) {
        const uint64_t keyed = word[i] ^ keys[i];
        lane[i] += word[i ^ 1] + (keyed & 0xffffffffu) * (keyed >> 32);
    }
}

static void scramble(uint64_t lane[LANES]) {
    for (int i = 0; i < LANES; i++)
        lane[i] = (lane[i] ^ lane[i] >> 47 ^ keys[i]) * 0x9e3779b1u;
}

void r_hashVertices(const RObjectVertex *vertices, int count, uint64_t hash[2]) {
    const size_t stripes = (size_t)count * WORDS_PER_VERTEX / LANES, rest = (size_t)count * WORDS_PER_VERTEX % LANES;
    const char *bytes = (const char *)vertices;
    uint64_t lane[LANES], word[LANES] = {0};
    memcpy(lane, keys, sizeof lane);
    for (size_t i = 0; i < stripes; i++) {
        memcpy(word, bytes + i * sizeof word, sizeof word);
        addStripe(lane, word);
        if (i % STRIPES_PER_BLOCK == STRIPES_PER_BLOCK - 1)
            scramble(lane);
    }
    memset(word, 0, sizeof word);
    if (rest)
        memcpy(word, bytes + stripes * sizeof word, rest * sizeof *word);
    addStripe(lane, word);
    hash[0] = hash[1] = (uint64_t)count;
    for (int i = 0; i < LANES; i++) {
        hash[0] = r_hashWord(hash[0], lane[i]);
        hash[1] = r_hashWord(hash[1], lane[LANES - 1 - i] ^ hash[0]);
    }
}
