/* Characters of a text. */
#ifndef R_TEXT_I_H
#define R_TEXT_I_H

#include <stdint.h>

/* The character at *text, which moves on to the next one. The text must not be at its end. */
uint32_t r_nextCharacter(const char **text);

#endif
