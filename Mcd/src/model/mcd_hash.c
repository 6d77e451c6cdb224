/* Hashing of inputs that are compared from step to step. */
#include "model/mcd_result_i.h"
#include <string.h>

/* Mixes a word into a 128-bit hash. Each half is a bijection of the word, so a change of one word always changes the
 * hash; changes of several words could only cancel by chance. */
static void addWord(MeU64 hash[2], MeU64 word) {
    hash[0] = (hash[0] ^ word) * 0x9e3779b97f4a7c15ull;
    hash[0] ^= hash[0] >> 29;
    hash[1] = (hash[1] + word) * 0xbf58476d1ce4e5b9ull;
    hash[1] ^= hash[1] >> 32;
}

void mcd_hashAdd(MeU64 hash[2], const void *data, size_t bytes) {
    for (size_t i = 0; i < bytes; i += sizeof(MeU64)) {
        MeU64 word = 0;
        memcpy(&word, (const char *)data + i, MeMIN(bytes - i, sizeof word));
        addWord(hash, word);
    }
}
