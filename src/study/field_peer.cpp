#include "study/field_peer.h"

#include <sstream>

#include "versus/request.h"

namespace contactscope {
namespace {

constexpr double kLongestMinutes = 10;

template <class List> void write_list(std::ostream& out, const char* word, const List& list) {
  out << word << ' ' << list.size() << '\n';
  for (const auto& entry : list) out << entry[0] << ' ' << entry[1] << ' ' << entry[2] << '\n';
}

PeerField read_answer(const std::string& program, const std::string& text, std::size_t points) {
  std::istringstream in(text);
  PeerField field;
  std::string word;
  std::size_t repetitions = 0;
  in >> word;
  std::getline(in >> std::ws, field.name);
  in >> word >> field.build >> word >> field.bytes >> word >> repetitions;
  for (std::size_t i = 0; in && i < repetitions; ++i) in >> field.nanoseconds.emplace_back();
  for (std::size_t i = 0; in && i < points; ++i) {
    Vec3d gradient;
    in >> field.distances.emplace_back() >> gradient.x() >> gradient.y() >> gradient.z();
    field.gradients.push_back(gradient);
  }
  if (!in) throw std::runtime_error(program + ": its answer is incomplete or not a number");
  return field;
}

}  // namespace

std::optional<PeerField> run_field_peer(const std::vector<std::string>& folders,
                                        const std::string& name, const Mesh<double>& mesh,
                                        int cells, int band, int repetitions,
                                        const std::vector<Vec3d>& points) {
  const auto program = versus::find_program("contactscope-field-" + name, folders);
  if (!program) return std::nullopt;
  std::ostringstream request;
  request.precision(std::numeric_limits<double>::max_digits10);
  request << "cells " << cells << " band " << band << " repetitions " << repetitions << '\n';
  write_list(request, "vertices", mesh.vertices);
  write_list(request, "triangles", mesh.triangles);
  write_list(request, "points", points);
  const versus::Answer answer =
      versus::run_program(*program, {}, request.str(), 60 * kLongestMinutes);
  if (!answer.failure.empty()) throw std::runtime_error(*program + ": " + answer.failure);
  return read_answer(*program, answer.out, points.size());
}

}  // namespace contactscope
