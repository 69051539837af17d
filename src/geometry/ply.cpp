#include "core/input_error.h"
#include "geometry/mesh_contents.h"

namespace contactscope {
namespace {

/// Types by their names of both versions of the format.
struct Type {
  std::string_view name, other;
  std::size_t size;
  double (*of)(const char* bytes);  // in the order of this machine
};
template <class T> double value_of(const char* bytes) {
  T value{};
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}
constexpr std::array kTypes = {Type{"char", "int8", 1, value_of<std::int8_t>},
                               Type{"uchar", "uint8", 1, value_of<std::uint8_t>},
                               Type{"short", "int16", 2, value_of<std::int16_t>},
                               Type{"ushort", "uint16", 2, value_of<std::uint16_t>},
                               Type{"int", "int32", 4, value_of<std::int32_t>},
                               Type{"uint", "uint32", 4, value_of<std::uint32_t>},
                               Type{"float", "float32", 4, value_of<float>},
                               Type{"double", "float64", 8, value_of<double>}};

struct Property {
  std::string name;
  const Type* type = nullptr;
  const Type* count = nullptr;  // of a list
};
struct Element {
  std::string name;
  int count = 0;
  std::vector<Property> properties{};
};

class PlyReader {
 public:
  PlyReader(const std::string& path, const std::string& written)
      : path_(path), written_(written), words_(path, written) {}

  MeshContents run() {
    read_header();
    for (const Element& element : elements_)
      for (int i = 0; i < element.count && !element.properties.empty(); ++i) read_one(element, i);
    return std::move(contents_);
  }

 private:
  void read_header() {
    if (words_.next() != "ply") words_.fail("a .ply file begins with 'ply'");
    for (;;) {
      const std::string_view word = words_.next();
      if (word == "format") {
        const std::string_view format = words_.next();
        is_text_ = format == "ascii";
        const bool is_big = format == "binary_big_endian";
        if (!is_text_ && !is_big && format != "binary_little_endian")
          words_.fail("the format is ascii, binary_little_endian or binary_big_endian");
        swaps_ = is_big == (std::endian::native == std::endian::little);
      } else if (word == "element") {
        const std::string name(words_.next());
        elements_.push_back({name, words_.count("the number of elements")});
      } else if (word == "property") {
        if (elements_.empty()) words_.fail("a property comes after its element");
        Property property;
        const std::string_view type = words_.next();
        if (type == "list") property.count = type_named(words_.next());
        property.type = type_named(type == "list" ? words_.next() : type);
        property.name = words_.next();
        elements_.back().properties.push_back(property);
      } else if (word != "comment" && word != "obj_info" && word != "end_header") {
        words_.fail(FileWords::quoted(word) +
                    " is no word of a header; expected element, property or end_header");
      }
      at_ = words_.skip_line();
      if (word == "end_header") return;
    }
  }

  const Type* type_named(std::string_view name) const {
    const auto* const found = std::ranges::find_if(
        kTypes, [&](const Type& type) { return type.name == name || type.other == name; });
    if (found == kTypes.end()) words_.fail(FileWords::quoted(name) + " is no type of a property");
    return found;
  }

  void read_one(const Element& element, int number) {
    Vec3d vertex = Vec3d::Zero();
    std::vector<int> face;
    for (const Property& property : element.properties) {
      if (property.count != nullptr) {
        const double corners = value(*property.count, element, number);
        if (!(corners >= 0 && corners <= double(kMaxCorners)))
          refuse(element, number, "has a list of " + std::to_string(corners) + " values");
        for (int k = 0; k < int(corners); ++k) {
          const double corner = value(*property.type, element, number);
          if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
          if (!(corner >= 0 && corner < 2e9)) refuse(element, number, "names no vertex");
          face.push_back(static_cast<int>(corner));
        }
        continue;
      }
      const double read = value(*property.type, element, number);
      const std::size_t axis = std::string_view("xyz").find(property.name);
      if (property.name.size() == 1 && axis < 3) vertex[static_cast<int>(axis)] = read;
    }
    if (element.name == "vertex") {
      if (!vertex.allFinite()) refuse(element, number, "is not finite");
      contents_.vertices.push_back(vertex);
    }
    if (element.name == "face") contents_.faces.push_back(std::move(face));
  }

  double value(const Type& type, const Element& element, int number) {
    if (is_text_) return words_.number("a value");
    if (at_ + type.size > written_.size()) refuse(element, number, "is cut off");
    std::array<char, 8> bytes{};
    std::copy_n(written_.data() + at_, type.size, bytes.data());
    if (swaps_) std::reverse(bytes.data(), bytes.data() + type.size);
    at_ += type.size;
    return type.of(bytes.data());
  }

  [[noreturn]] void refuse(const Element& element, int number, const std::string& what) const {
    throw InputError(path_, 0, 0,
                     FileWords::quoted(element.name) + " " + std::to_string(number) + " " + what);
  }

  const std::string& path_;
  const std::string& written_;
  FileWords words_;
  std::size_t at_ = 0;  // of binary data
  bool is_text_ = true, swaps_ = false;
  std::vector<Element> elements_;
  MeshContents contents_;
};

}  // namespace

MeshContents read_ply(const std::string& path, const std::string& written) {
  return PlyReader(path, written).run();
}

}  // namespace contactscope
