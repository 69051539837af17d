#pragma once

#include <string>
#include <vector>

#include "draw/scene/pen.h"

namespace contactscope::draw {

/// Rows of text on a panel, from the top down, in the embedded fonts. What is too wide is cut with
/// an ellipsis, or goes on in another line.
class Sheet {
 public:
  /// `rect`: what is inside of the panel's padding; `scale`: pixels for one at 720 lines.
  Sheet(const Rect& rect, float scale, Drawing& drawing);

  /// In bold, with a thin rule under it.
  void heading(const std::string& text);
  void line(const std::string& text, const Color& color) { lines({text}, color); }
  /// Close under each other.
  void lines(const std::vector<std::string>& all, const Color& color) {
    write(all, static_cast<float>(rect_.x), color);
  }
  void paragraph(const std::string& text, const Color& color);
  /// Names in a column of their own, left of the values.
  void row(const std::string& name, const std::string& value);
  /// Moves down past something this high. Rows begin on whole pixels.
  void skip(float pixels);
  /// Goes on at this height of the canvas.
  void skip_to(double y) { y_ = static_cast<float>(y); }
  /// "and 2 more pairs"; of none nothing. Returns "2 pairs".
  std::string more(std::size_t count, const char* one, const char* many);

  /// What is left under the last row.
  Rect rest() const;
  const Pen& pen() const { return pen_; }
  float text_height() const { return text_; }
  /// From a row to the next.
  float line_height() const { return text_ + spacing_; }

  /// Of a panel at this scale, pixels.
  static float line_height(float scale);
  static float heading_height(float scale);

 private:
  void write(const std::vector<std::string>& lines, float x, const Color& color);

  Rect rect_;
  Pen pen_;
  float text_, spacing_;  // pixels
  float y_;               // of the next row
};

/// Words in as many lines as they take at this width.
std::vector<std::string> wrapped(const std::string& text, float size, float width);

}  // namespace contactscope::draw
