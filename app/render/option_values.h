// What stands behind an option, as numbers: "3.5", "0:100", "x=2,y<0", "30,20".
//
// Every function throws Error (Fault::usage) for a text it cannot read, and says what it should be.

#pragma once

#include "app/render/options.h"

#include <string>
#include <string_view>
#include <vector>

namespace billet::render {

/// @throws Error  (Fault::usage) with the usual remedy
[[noreturn]] void fail_usage(const std::string& message);

[[nodiscard]] double number(std::string_view text);

/// A whole number of something between bounds; `what` is named in the message.
[[nodiscard]] int count(const std::string& text, int least, int most, const std::string& what);

/// A number above zero.
[[nodiscard]] double positive(const std::string& text, const std::string& what);

/// Parts of a text between separators.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

/// Two numbers.
[[nodiscard]] std::array<double, 2> pair(const std::string& text, char separator);

[[nodiscard]] std::array<int, 2> picture_size(const std::string& text);

/// FILE.csv:X-COLUMN:Y-COLUMN[:LABEL]
[[nodiscard]] Series series(const std::string& text, bool points);

/// X:Y[,Y...]
[[nodiscard]] Columns columns(const std::string& text);

/// 0, 1 or 2 of "x", "y" or "z".
[[nodiscard]] int axis(const std::string& text);

/// x=3.5, x<3.5 or x>3.5, several with commas between.
[[nodiscard]] Cut cut(const std::string& text);

/// x, -x, ..., iso or AZIMUTH,ELEVATION into a view.
void take_direction(View& view, const std::string& text);

/// x,y,z
[[nodiscard]] Vec3 place(const std::string& text);

/// T or last, several with commas between.
[[nodiscard]] std::vector<AskedTime> times(const std::string& text);

/// x, xy, x,y or x=0,y=2.5
[[nodiscard]] Mirror mirror(const std::string& text);

/// A:B:STEP, each of which may be left out.
[[nodiscard]] FrameSlice slice(const std::string& text);

[[nodiscard]] ToolStyle tool_style(const std::string& text);
[[nodiscard]] Place place_of_field(const std::string& text);

/// Short words for fields: "pressure" for "contact_pressure".
[[nodiscard]] std::string field_name(const std::string& text);

} // namespace billet::render
