#include "snapshot/check.h"

namespace contactscope::snapshot {
namespace {

/// A 64-bit hash of a sequence: per eight bytes one multiplication and a fold of its 128 bits, as
/// wyhash mixes. Not collision-resistant against attackers.
class Mixer {
 public:
  void add(std::uint64_t value) {
    const __uint128_t product =
        static_cast<__uint128_t>(state_ ^ value ^ 0x9E3779B97F4A7C15u) * 0xD6E8FEB86659FD93u;
    state_ = static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64) ^
             std::rotl(state_, 29);
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }  // -0 becomes 0
  void add(float value) { add(static_cast<double>(value)); }
  void add(bool value) { add(std::uint64_t{value ? 2u : 1u}); }
  void add(int value) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(value))); }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      word = word << 8 | static_cast<unsigned char>(text[i]);
      if (i % 8 == 7) add(std::exchange(word, 0));
    }
    add(word);
  }
  void add(const std::string& text) { add(std::string_view(text)); }
  void add(const Vec3d& vector) {
    for (int i = 0; i < 3; ++i) add(vector[i]);
  }
  void add(const Quatd& rotation) {
    for (int i = 0; i < 4; ++i) add(rotation.coeffs()[i]);
  }
  void add(const trace::SimplexVertex& vertex) {
    add(vertex.a);
    add(vertex.b);
  }
  template <class T, std::size_t N> void add(const std::array<T, N>& values) {
    for (const T& value : values) add(value);
  }
  template <class T> void add(const std::vector<T>& values) {
    add(std::uint64_t{values.size()});
    for (const auto& value : values) add(static_cast<const T&>(value));
  }
  template <class T>
  requires trace::kIsOptional<T>
  void add(const T& value) {
    if (value) add(*value);
  }
  template <trace::Listed T> void add(const T& fact) {
    trace::each_field<T>([&]<class Value>(const trace::Field<T, Value>& field) {
      const Value& value = fact.*field.member;
      if constexpr (requires { value.empty(); }) {
        if (value.empty()) return;
      }
      if constexpr (trace::kIsOptional<Value>) {
        if (!value) return;
      }
      add(std::string_view(field.key));
      add(value);
    });
  }

  std::string text() const { return printed("%016llx", static_cast<unsigned long long>(state_)); }

 private:
  std::uint64_t state_ = 0;
};

template <class S> void add_rounding(Mixer& mixer) {
  // volatile: a constant folded by the compiler would round as on the build machine.
  volatile S start = S(0.1);
  S angle = start;
  Vec3<S> sum = Vec3<S>::Zero();
  for (int i = 0; i < 512; ++i) {
    angle += S(0.37);
    const Vec3<S> vector(std::sin(angle), std::cos(angle), std::sqrt(angle));
    sum += vector.cross(Vec3<S>(S(1), angle, S(-2))).normalized() * std::atan2(angle, S(i + 1));
    mixer.add(sum.dot(vector));
    mixer.add(std::acos(vector.x()));
    mixer.add(std::exp(-angle));
  }
  for (int i = 0; i < 3; ++i) mixer.add(sum[i]);
}

}  // namespace

std::string hash_of(const trace::Frame& frame) {
  Mixer mixer;
  mixer.add(frame);
  return mixer.text();
}

const std::string& rounding() {
  static const std::string text = [] {
    Mixer mixer;
    add_rounding<float>(mixer);
    add_rounding<double>(mixer);
    return mixer.text();
  }();
  return text;
}

std::string to_text(const FrameHashes& hashes) {
  std::string text = "rounding " + hashes.rounding + "\n";
  for (const auto& [frame, hash] : hashes.hashes) text += std::to_string(frame) + " " + hash + "\n";
  return text;
}

FrameHashes parse_hashes(const std::string& text, const std::string& path) {
  std::istringstream lines(text);
  std::string word;
  FrameHashes hashes;
  if (!(lines >> word >> hashes.rounding) || word != "rounding")
    throw std::runtime_error(path + " does not begin with 'rounding' and 16 digits");
  int frame = 0;
  std::string hash;
  while (lines >> frame >> hash) hashes.hashes[frame] = hash;
  if (!lines.eof()) throw std::runtime_error(path + " has a line that is not 'FRAME HASH'");
  return hashes;
}

}  // namespace contactscope::snapshot
