#pragma once

#include <string>

#include "viewer/gui.h"

namespace cpslam::viewer {

/// As printf would write it.
[[nodiscard]] std::string text(const char* format, ...) __attribute__((format(printf, 1, 2)));
/// "12 345"
[[nodiscard]] std::string grouped(std::size_t count);

/// A word on a coloured ground.
void pill(const Gui& gui, const char* word, Colour colour);
/// Small words on a dark ground, anywhere in the current window; upper left corner.
void label(const Gui& gui, ImVec2 corner, const std::string& words, Colour colour);
/// A coloured dot before what follows on the line.
void dot(Colour colour);
/// Text in the quieter colour.
void quiet(const std::string& words);
/// Quiet text at the right end of the line.
void right_aligned(const std::string& words);
/// A checkbox with a coloured dot before its label; whether it was changed.
bool layer_switch(const char* label, Colour colour, bool& on);
/// A button that is lit while chosen; whether it was pressed. tip: shown when the mouse rests on it.
bool choice(const char* label, bool chosen, const char* tip);

}  // namespace cpslam::viewer
