#include <istream>
#include <string>

#include "core/input_error.h"
#include "trace/json.h"
#include "trace/read_node.h"

namespace contactscope::trace {
namespace {

/// How many entries the lists have that were read of a fact and of those around it.
struct Counts {
  const Counts* around = nullptr;
  std::vector<std::pair<std::string_view, std::size_t>> lists{};

  std::size_t of(std::string_view list) const {
    for (const auto& [key, count] : lists) {
      if (key == list) return count;
    }
    return around != nullptr ? around->of(list) : 0;
  }
};

template <Listed T>
T read(const Node& node, const Counts* around);

/// Reads the value of one field.
template <class Field>
class Value {
 public:
  Value(const Field& field, const Counts& counts) : field_(field), counts_(counts) {}

  void read(const Node& node, std::string& value) const { value = node.string(); }
  void read(const Node& node, bool& value) const { value = node.boolean(); }
  void read(const Node& node, double& value) const { value = node.number(); }
  void read(const Node& node, int& value) const {
    value = node.integer();
    if (field_.counts_in == nullptr || (field_.may_be_none && value < 0)) return;
    value = node.index(counts_.of(field_.counts_in), field_.things);
  }
  void read(const Node& node, Vec3d& value) const {
    const std::vector<double> v = node.numbers(3, "must have three numbers");
    value = {v[0], v[1], v[2]};
  }
  void read(const Node& node, Quatd& value) const {
    const std::vector<double> q = node.numbers(4, "needs four numbers");
    value = Quatd(q[0], q[1], q[2], q[3]);
  }
  template <class T>
  void read(const Node& node, std::optional<T>& value) const {
    read(node, value.emplace());
  }
  template <Listed T>
  void read(const Node& node, T& value) const {
    value = trace::read<T>(node, &counts_);
  }
  template <class T>
  void read(const Node& node, std::vector<T>& list) const {
    if constexpr (Listed<T>) {
      if constexpr (has_name<T>()) {
        for (const auto& [name, item] : node.members()) {
          read(item, list.emplace_back());
          name_of(list.back()) = name;
        }
        return;
      }
    }
    for (const Node& item : node.items()) read(item, list.emplace_back());
  }
  template <class T, std::size_t Count>
  void read(const Node& node, std::array<T, Count>& list) const {
    const std::vector<Node> parts = node.items();
    if (parts.size() != Count) {
      node.fail(std::same_as<T, int> ? "must have " + std::to_string(Count) + " indices"
                                     : "must have two points");
    }
    for (std::size_t i = 0; i < Count; ++i) read(parts[i], list[i]);
  }

 private:
  const Field& field_;
  const Counts& counts_;
};

template <class T>
void require_more(const Node&, const T&) {}
/// Only some rules measure against an edge, and those need it.
void require_more(const Node& node, const Choice& choice) {
  if (!choice.is_against_edges()) return;
  for (const Node& measure : node.at("measures").items()) measure.at("edge");
}

template <Listed T>
T read(const Node& node, const Counts* around) {
  T fact;
  Counts counts{around};
  each_field<T>([&]<class V>(const Field<T, V>& field) {
    V& value = fact.*field.member;
    const Value reader(field, counts);
    if (field.is_object_key) return;
    if (field.is_merged) return reader.read(node, value);
    const Node owner = field.within != nullptr ? node.at(field.within) : node;
    if (const auto found = field.needed() ? owner.at(field.key) : owner.find(field.key)) {
      reader.read(*found, value);
    } else if (field.otherwise != nullptr) {
      field.otherwise(fact);
    }
    if constexpr (requires { value.push_back(value.front()); })
      counts.lists.emplace_back(field.key, value.size());
  });
  require_more(node, fact);
  return fact;
}

Header read_header(const Node& node) {
  const Node schema = node.at("schema");
  if (schema.string() != kSchema)
    schema.fail("is '" + schema.string() + "'; '" + kSchema + "' is what can be read here");
  return read<Header>(node, nullptr);
}

}  // namespace

Trace read_trace(std::istream& in, const std::string& name) {
  Trace trace;
  bool has_header = false;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      const Json json = Json::parse(line);
      const Node node(json, "");
      if (has_header) {
        trace.frames.push_back(read<Frame>(node, nullptr));
      } else {
        trace.header = read_header(node);
        has_header = true;
      }
    } catch (const nlohmann::json::parse_error& error) {
      throw InputError(name, number, static_cast<int>(error.byte),
                       "this line is no JSON from here on; a trace has one whole object on each "
                       "line, so it may be torn: make it again");
    } catch (const nlohmann::json::exception& error) {
      throw InputError(name, number, 1, std::string("not read: ") + error.what());
    } catch (const Complaint& complaint) {
      throw InputError(name, number, 1, complaint.message);
    }
  }
  if (!has_header)
    throw InputError(name, 0, 0,
                     std::string("the trace is empty; its first line must be a header with "
                                 "\"schema\":\"") +
                         kSchema + "\"");
  return trace;
}

}  // namespace contactscope::trace
