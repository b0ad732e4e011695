#pragma once

#include <array>
#include <string_view>

namespace lagomorph::apps {

/// Letters of the contact sheet as pen strokes, ASCII from the space on. Strokes stand between spaces; a
/// point is a digit, x, and a letter, y from a = -4: the baseline e = 0, small letters up to m = 8, capitals
/// up to q = 12.
inline constexpr std::array<std::string_view, 95> glyphs = {
    "",                                            // space
    "0q0i 0e0e",                                   // !
    "0q0n 2q2n",                                   // "
    "2q1e 6q5e 0m7m 0i7i",                         // #
    "7o5p2p0n0l2k5k7i7g5f2f0g 4r4d",               // $
    "0e7q 1q0p0n1m2m3n3p2q1q 5i4h4f5e6e7f7h6i5i",  // %
    "8e2m2o3q5q6o6n0i0g2e5e8i",                    // &
    "0q0n",                                        // '
    "3q1o0l0h1e3c",                                // (
    "0q2o3l3h2e0c",                                // )
    "3o3i 0n6j 6n0j",                              // *
    "3m3g 0j6j",                                   // +
    "1e0c",                                        // ,
    "0j4j",                                        // -
    "0e0e",                                        // .
    "0d5q",                                        // /
    "2e5e7g7o5q2q0o0g2e",                          // 0
    "0o3q3e",                                      // 1
    "0o2q5q7o7m0e7e",                              // 2
    "0o2q5q7o7m5k2k 5k7i7g5e2e0g",                 // 3
    "5e5q0h7h",                                    // 4
    "7q1q0k2l5l7j7g5e2e0g",                        // 5
    "6q3q0n0g2e5e7g7i5k2k0i",                      // 6
    "0q7q3e",                                      // 7
    "2k0i0g2e5e7g7i5k2k0m0o2q5q7o7m5k",            // 8
    "1e4e7h7o5q2q0o0m2k5k7m",                      // 9
    "0l0l 0f0f",                                   // :
    "1l1l 1f0d",                                   // ;
    "6o0j6e",                                      // <
    "0l6l 0h6h",                                   // =
    "0o6j0e",                                      // >
    "0o2q4q6o6m3j3i 3e3e",                         // ?
    "6i4g3g2i2k4m6l6h8h8o6q2q0o0g2e7e",            // @
    "0e4q8e 1i7i",                                 // A
    "0e0q5q7o7m5k0k 5k7i7g5e0e",                   // B
    "7o5q2q0o0g2e5e7g",                            // C
    "0e0q4q7n7h4e0e",                              // D
    "6q0q0e6e 0k5k",                               // E
    "6q0q0e 0k5k",                                 // F
    "7o5q2q0o0g2e5e7g7k4k",                        // G
    "0q0e 7q7e 0k7k",                              // H
    "0q0e",                                        // I
    "5q5g3e2e0g",                                  // J
    "0q0e 7q0i 2k7e",                              // K
    "0q0e6e",                                      // L
    "0e0q4i8q8e",                                  // M
    "0e0q7e7q",                                    // N
    "2e6e8g8o6q2q0o0g2e",                          // O
    "0e0q5q7o7l5j0j",                              // P
    "2e6e8g8o6q2q0o0g2e 5h8d",                     // Q
    "0e0q5q7o7l5j0j 3j7e",                         // R
    "7o5q2q0o0m2k5k7i7g5e2e0g",                    // S
    "0q8q 4q4e",                                   // T
    "0q0g2e5e7g7q",                                // U
    "0q4e8q",                                      // V
    "0q2e4n6e8q",                                  // W
    "0q7e 7q0e",                                   // X
    "0q4k8q 4k4e",                                 // Y
    "0q7q0e7e",                                    // Z
    "2q0q0c2c",                                    // [
    "0q5d",                                        // backslash
    "0q2q2c0c",                                    // ]
    "0m3q6m",                                      // ^
    "0d6d",                                        // _
    "0q2o",                                        // `
    "6m6e 6k4m2m0k0g2e4e6g",                       // a
    "0q0e 0k2m4m6k6g4e2e0g",                       // b
    "6l4m2m0k0g2e4e6f",                            // c
    "6q6e 6k4m2m0k0g2e4e6g",                       // d
    "0i6i6k4m2m0k0g2e5e",                          // e
    "4q3q1o1e 0m4m",                               // f
    "6m6c4a1a 6k4m2m0k0g2e4e6g",                   // g
    "0q0e 0k2m4m6k6e",                             // h
    "0m0e 0p0p",                                   // i
    "2m2c0a 2p2p",                                 // j
    "0q0e 5m0i 2j6e",                              // k
    "0q0e",                                        // l
    "0m0e 0k2m3m4k4e 4k6m7m8k8e",                  // m
    "0m0e 0k2m4m6k6e",                             // n
    "2e4e6g6k4m2m0k0g2e",                          // o
    "0m0a 0k2m4m6k6g4e2e0g",                       // p
    "6m6a 6k4m2m0k0g2e4e6g",                       // q
    "0m0e 0k2m4m",                                 // r
    "6l4m2m0k2i4i6g4e2e0f",                        // s
    "1p1g2e4e 0m4m",                               // t
    "0m0g2e4e6g 6m6e",                             // u
    "0m3e6m",                                      // v
    "0m2e4k6e8m",                                  // w
    "0m5e 5m0e",                                   // x
    "0m3e 6m2a0a",                                 // y
    "0m5m0e5e",                                    // z
    "3q2q1p1l0j1h1d2c3c",                          // {
    "0q0c",                                        // |
    "0q1q2p2l3j2h2d1c0c",                          // }
    "0i1k2k4i5i6k",                                // ~
};
struct Sign {
  std::string_view character, glyph;
};
/// Other characters in the same way.
inline constexpr std::array<Sign, 14> signs = {{
    {"\u2264", "6q0m6i 0e6e"},                  // at most
    {"\u2265", "0q6m0i 0e6e"},                  // at least
    {"\u00B0", "1q3q4p4n3m1m0n0p1q"},           // degree
    {"\u00B7", "0j0j"},                         // middle dot
    {"\u00D7", "0m6g 6m0g"},                    // times
    {"\u00B1", "3n3h 0k6k 0e6e"},               // plus or minus
    {"\u00B5", "0m0a 0g2e4e6g 6m6e"},           // micro
    {"\u03BC", "0m0a 0g2e4e6g 6m6e"},           // mu
    {"\u03B5", "6l4m2m0l0k2j4j 2j0i0g2e4e6f"},  // epsilon
    {"\u03BB", "0q1q2p6e 4k0e"},                // lambda
    {"\u03BD", "0m1m3e6i6m"},                   // nu
    {"\u03C0", "0k1m7m 2m2e 5m5f6e"},           // pi
    {"\u03C1", "0a0k2m4m6k6g4e2e0g"},           // rho
    {"\u03C3", "8m2m0k0g2e4e6g6k4m"},           // sigma
}};
/// What is written for the letters from U+00C0 to U+017F: those they are made of, without accents. The two
/// that are no letters have none.
inline constexpr std::array<std::string_view, 192> base_letters = {
    "A", "A", "A",  "A",  "A", "A", "AE", "C", "E", "E",  "E", "E", "I", "I", "I",  "I",   // U+00C0
    "D", "N", "O",  "O",  "O", "O", "O",  "",  "O", "U",  "U", "U", "U", "Y", "Th", "ss",  // U+00D0
    "a", "a", "a",  "a",  "a", "a", "ae", "c", "e", "e",  "e", "e", "i", "i", "i",  "i",   // U+00E0
    "d", "n", "o",  "o",  "o", "o", "o",  "",  "o", "u",  "u", "u", "u", "y", "th", "y",   // U+00F0
    "A", "a", "A",  "a",  "A", "a", "C",  "c", "C", "c",  "C", "c", "C", "c", "D",  "d",   // U+0100
    "D", "d", "E",  "e",  "E", "e", "E",  "e", "E", "e",  "E", "e", "G", "g", "G",  "g",   // U+0110
    "G", "g", "G",  "g",  "H", "h", "H",  "h", "I", "i",  "I", "i", "I", "i", "I",  "i",   // U+0120
    "I", "i", "IJ", "ij", "J", "j", "K",  "k", "k", "L",  "l", "L", "l", "L", "l",  "L",   // U+0130
    "l", "L", "l",  "N",  "n", "N", "n",  "N", "n", "'n", "N", "n", "O", "o", "O",  "o",   // U+0140
    "O", "o", "OE", "oe", "R", "r", "R",  "r", "R", "r",  "S", "s", "S", "s", "S",  "s",   // U+0150
    "S", "s", "T",  "t",  "T", "t", "T",  "t", "U", "u",  "U", "u", "U", "u", "U",  "u",   // U+0160
    "U", "u", "U",  "u",  "W", "w", "Y",  "y", "Y", "Z",  "z", "Z", "z", "Z", "z",  "s",   // U+0170
};
/// Of what has no letter here.
inline constexpr std::string_view box_glyph = "0e0q6q6e0e";

}  // namespace lagomorph::apps
