#include "vector/svg.h"

#include "vector/pieces.h"

namespace contactscope::vector {
namespace {

/// Appends a number in its shortest form: "-.5", "12", "0".
void add_hundredths(std::int64_t hundredths, std::string& out) {
  const std::int64_t size = hundredths < 0 ? -hundredths : hundredths;
  if (hundredths < 0) out += '-';
  const std::int64_t whole = size / 100, rest = size % 100;
  if (whole > 0 || rest == 0) out += std::to_string(whole);
  if (rest == 0) return;
  out += '.';
  out += static_cast<char>('0' + rest / 10);
  if (rest % 10 != 0) out += static_cast<char>('0' + rest % 10);
}

constexpr double kPixelOfCss = 0.75;  // points

/// Path data with relative steps in whole hundredths of a pixel, so that rounding errors do not
/// accumulate.
class PathData {
 public:
  explicit PathData(std::string& out) : out_(out) {}

  void trace(const std::vector<Point2>& points, bool closed) {
    move_to(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) line_to(points[i]);
    if (!closed) return;
    out_ += 'z';
    last_ = 'z';
  }

 private:
  struct Place {
    std::int64_t x = 0, y = 0;
  };

  void move_to(const Point2& to) {
    const Place place = rounded(to);
    out_ += 'M';
    add(place.x);
    separate(place.y);
    at_ = place;
    last_ = 'L';  // numbers after a move are lines
    begun_ = false;
  }
  void line_to(const Point2& to) {
    const Place place = rounded(to);
    const std::int64_t dx = place.x - at_.x, dy = place.y - at_.y;
    if (dx == 0 && dy == 0 && begun_) return;  // less than 1/100 pixel
    begun_ = true;
    if (dy == 0) {
      command('h', dx);
    } else if (dx == 0) {
      command('v', dy);
    } else {
      command('l', dx);
      separate(dy);
    }
    at_ = place;
  }
  static Place rounded(const Point2& p) {
    return {std::llround(static_cast<double>(p.x) * 100),
            std::llround(static_cast<double>(p.y) * 100)};
  }
  void command(char letter, std::int64_t value) {
    if (letter == last_) {
      separate(value);
      return;
    }
    out_ += letter;
    last_ = letter;
    add(value);
  }
  // A minus sign also separates numbers.
  void separate(std::int64_t value) {
    if (value >= 0) out_ += ' ';
    add(value);
  }
  void add(std::int64_t hundredths) { add_hundredths(hundredths, out_); }

  std::string& out_;
  Place at_;
  char last_ = 0;
  bool begun_ = false;
};

struct SvgWriter {
  const draw::Drawing& drawing;
  const SvgOptions& options;
  std::string out{};
  std::map<std::string, int> ids{};  // uses of each id
  UsedCharacters used{};

  std::string write() {
    out.reserve(64 * drawing.primitives.size() + 40'000);
    add_characters(drawing, used);
    begin_file();
    for (const Group& group : groups_of(drawing)) add(group);
    out += "</svg>\n";
    return std::move(out);
  }

  void attribute(const char* name, std::string_view value) {
    out += ' ';
    out += name;
    out += "=\"";
    out += value;
    out += '"';
  }
  void attribute(const char* name, double value) { attribute(name, number(value)); }
  void paint(const char* what, const char* opacity, const Color& color) {
    attribute(what, hex(color));
    if (color.a < 1) attribute(opacity, color.a);
  }

  void begin_file() {
    const std::string width = std::to_string(drawing.width);
    const std::string height = std::to_string(drawing.height);
    out += "<svg xmlns=\"http://www.w3.org/2000/svg\"";
    const double points = drawing.points_per_pixel;
    const bool pixels = std::abs(points - kPixelOfCss) < 1e-6;
    const auto size = [&](const std::string& requested, int length) {
      if (!requested.empty()) return requested;
      return pixels ? std::to_string(length) : number(points * length) + "pt";
    };
    attribute("width", size(options.width, drawing.width));
    attribute("height", size(options.height, drawing.height));
    attribute("viewBox", "0 0 " + width + " " + height);
    attribute("font-family", families(used));
    attribute("stroke-linejoin", "round");
    if (!options.id_prefix.empty()) attribute("id", options.id_prefix + "picture");
    out += ">\n";
    if (options.origin != nullptr) add_origin(*options.origin);
    add_style();
    if (drawing.background.a <= 0) return;
    out += "<rect";
    attribute("id", options.id_prefix + "background");
    attribute("width", width);
    attribute("height", height);
    paint("fill", "fill-opacity", drawing.background);
    out += "/>\n";
  }

  void add_origin(const PictureOrigin& origin) {
    if (!origin.title.empty()) out += "<title>" + escaped(origin.title) + "</title>\n";
    const auto entries = entries_of(origin);
    std::string record;
    for (const auto& [key, value] : entries)
      if (key != "Title") record += (record.empty() ? "" : "; ") + key + ": " + value;
    out += "<desc>" + escaped(record) + "</desc>\n<metadata>";
    out += "<picture xmlns=\"urn:contactscope:picture\"";
    for (const auto& [key, value] : entries) {
      std::string name = key;  // "Scenario SHA-256" becomes "scenario-sha-256"
      for (char& c : name) c = c == ' ' ? '-' : static_cast<char>(std::tolower(c));
      attribute(name.c_str(), escaped(value));
    }
    out += "/></metadata>\n";
  }

  // No kerning or ligatures, so that digits stay tabular.
  void add_style() {
    if (!options.embed_font) return;
    FontFaces own;
    FontFaces& fonts = options.fonts != nullptr ? *options.fonts : own;
    out += "<style>text{font-kerning:none;font-variant-ligatures:none}" + fonts.css(used) +
           "</style>\n";
  }

  void add(const Group& group) {
    const bool grouped = group.part != nullptr;
    if (grouped) begin_group(*group.part);
    // No soft edges, as in the rasterizer: the background would shine through.
    const bool surface = grouped && group.part->role == "surface";
    for (const Piece& piece : group.pieces)
      std::visit([&](const auto& shape) { add(shape, surface); }, piece);
    if (grouped) out += "</g>\n";
  }

  void begin_group(const Part& part) {
    // Panels and insets have a name; other roles are not part of the id.
    const bool named = part.layer == draw::kPanelPart || part.layer == draw::kInsetPart;
    std::string id = part.layer;
    if (named && !part.role.empty()) id += "-" + part.role;
    id = name_token(id);
    const int count = ++ids[id];
    const std::string classes = "layer " + name_token(part.layer);
    out += "<g";
    attribute("id", options.id_prefix + id + (count > 1 ? "-" + std::to_string(count) : ""));
    attribute("class", classes);
    if (!part.pair.empty()) attribute("data-pair", escaped(part.pair));
    if (!part.role.empty()) attribute("data-role", escaped(part.role));
    out += ">\n";
  }

  // Ids and classes must not contain spaces.
  static std::string name_token(std::string name) {
    for (char& c : name)
      if (static_cast<unsigned char>(c) <= ' ' || c == '"' || c == '<' || c == '&') c = '-';
    return name;
  }

  void add(const FillPath& fill, bool surface) {
    out += "<path d=\"";
    PathData data(out);
    for (const std::vector<Point2>& polygon : fill.polygons) data.trace(polygon, true);
    out += '"';
    paint("fill", "fill-opacity", fill.color);
    if (surface) attribute("shape-rendering", "crispEdges");
    out += "/>\n";
  }

  void add(const StrokePath& stroke, bool) {
    out += "<path d=\"";
    PathData data(out);
    for (const Polyline& line : stroke.lines) data.trace(line.points, line.closed);
    out += '"';
    attribute("fill", "none");
    paint("stroke", "stroke-opacity", stroke.color);
    if (stroke.width != 1) attribute("stroke-width", stroke.width);
    if (stroke.cap == Cap::Round) attribute("stroke-linecap", "round");
    if (stroke.gap > 0) {
      attribute("stroke-dasharray", number(stroke.dash) + " " + number(stroke.gap));
      if (stroke.phase != 0) attribute("stroke-dashoffset", stroke.phase);
    }
    out += "/>\n";
  }

  void add(const Disc& disc, bool) {
    const bool ring = disc.inner > 0;
    out += "<circle";
    attribute("cx", disc.center.x);
    attribute("cy", disc.center.y);
    attribute("r", ring ? 0.5f * (disc.inner + disc.outer) : disc.outer);
    if (ring) {
      attribute("fill", "none");
      paint("stroke", "stroke-opacity", disc.color);
      attribute("stroke-width", disc.outer - disc.inner);
    } else {
      paint("fill", "fill-opacity", disc.color);
    }
    out += "/>\n";
  }

  void add(const PlacedText& placed, bool) {
    const Text& text = *placed.text;
    out += "<text";
    // Anchor at the aligned end, so that other fonts fit too.
    attribute("x", placed.left.x + 0.5f * static_cast<float>(text.align) * placed.width);
    attribute("y", placed.left.y);
    if (text.align == draw::Align::Center) attribute("text-anchor", "middle");
    if (text.align == draw::Align::Right) attribute("text-anchor", "end");
    attribute("font-size", em_size(text.size, text.weight));
    if (text.weight == draw::Weight::Bold) attribute("font-weight", "700");
    paint("fill", "fill-opacity", text.color);
    if (text.halo > 0 && text.halo_color.a > 0) {
      paint("stroke", "stroke-opacity", text.halo_color);
      attribute("stroke-width", 2 * text.halo);
      attribute("paint-order", "stroke");
    }
    const std::string& words = text.text;
    const bool spaced =
        words.find("  ") != std::string::npos || words.front() == ' ' || words.back() == ' ';
    if (spaced) attribute("xml:space", "preserve");
    out += '>';
    out += escaped(words);
    out += "</text>\n";
  }
};

}  // namespace

std::string svg_of(const draw::Drawing& drawing, const SvgOptions& options) {
  return SvgWriter{drawing, options}.write();
}

std::string number(double value) {
  std::string out;
  add_hundredths(std::llround(value * 100), out);
  return out;
}

std::string hex(const draw::Color& color) {
  std::string out = "#";
  bool brief = true;
  for (const float channel : {color.r, color.g, color.b}) {
    const int byte = static_cast<int>(std::clamp(channel, 0.0f, 1.0f) * 255 + 0.5f);
    out += "0123456789abcdef"[byte / 16];
    out += "0123456789abcdef"[byte % 16];
    brief = brief && byte / 16 == byte % 16;
  }
  return brief ? std::string{'#', out[1], out[3], out[5]} : out;
}

std::string escaped(std::string_view text) {
  constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const std::size_t length = utf8_length(text, i);
    const std::string_view one = text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
    if (length != 1) {
      const bool is_known = length > 0 && one != "\xEF\xBF\xBE" && one != "\xEF\xBF\xBF";
      out += is_known ? one : kReplacement;
      continue;
    }
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

std::string in_script(std::string_view json) {
  std::string out;
  out.reserve(json.size() + json.size() / 8);
  for (std::size_t i = 0; i < json.size(); ++i) {
    const std::string_view line_end = json.substr(i, 3);
    if (json[i] == '<')
      out += "\\u003c";
    else if (json[i] == '>')
      out += "\\u003e";
    else if (json[i] == '&')
      out += "\\u0026";
    else if (line_end == "\xE2\x80\xA8" || line_end == "\xE2\x80\xA9") {
      out += line_end.back() == '\xA8' ? "\\u2028" : "\\u2029";
      i += 2;
    } else
      out += json[i];
  }
  return out;
}

}  // namespace contactscope::vector
