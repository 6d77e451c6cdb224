/* The letters: the file DejaVuSans.ttf, as Debian installs it, made part of the library by the assembler. */
#include "r_i.h"

__asm__(".section .rodata\n"
        ".hidden r_fontFile\n.global r_fontFile\nr_fontFile:\n"
        ".incbin \"" KARMA_FONT "\"\n"
        ".hidden r_fontFileEnd\n.global r_fontFileEnd\nr_fontFileEnd:\n"
        ".byte 0\n.previous\n");
