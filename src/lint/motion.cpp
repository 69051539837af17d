#include "lint/balance.h"
#include "lint/watch.h"
#include "trace/find.h"

namespace contactscope::lint {
namespace {

constexpr std::array kUnits = {std::pair("centimetres", 100.0), std::pair("millimetres", 1000.0)};
constexpr int kEnough = 5;      // minimum number of samples
constexpr double kAlike = 0.1;  // samples differ by at most this share

/// A number from many frames or bodies.
struct Samples {
  Thinned<double, 10'000> values;
  int count = 0;
  double least = 0, most = 0;
  int line = 0, frame = 0;
  std::string name;  // of the first

  void add(double value, int at_line, int at_frame, const std::string& of) {
    if (count++ == 0) line = at_line, frame = at_frame, name = of, least = most = value;
    least = std::min(least, value);
    most = std::max(most, value);
    values.add(value);
  }
  Finding finding(const std::string& cause, const std::string& what, const std::string& remedy,
                  const std::string& said, const std::string& is) const {
    Finding one{cause, what, remedy, count, count, line, frame, name, "", said, is};
    one.cases = "poses";
    return one;
  }
  Finding of_unit(const std::string& unit, double factor, const std::string& said,
                  const std::string& in_metres) const {
    return finding("world_in_" + unit, "lengths are in " + unit,
                   "divide all lengths by " + shown(factor) + ": a trace is in metres", said,
                   "in metres it would be " + in_metres);
  }
  /// The median, if most samples are close to it.
  std::optional<double> common() const {
    if (values.kept().size() < kEnough) return std::nullopt;
    std::vector<double> sorted = values.kept();
    std::ranges::sort(sorted);
    const double middle = sorted[sorted.size() / 2];
    const auto alike = std::ranges::count_if(
        sorted, [&](double v) { return std::abs(v - middle) <= kAlike * std::abs(middle); });
    return alike >= 0.8 * static_cast<double>(sorted.size()) ? std::optional(middle) : std::nullopt;
  }
};

bool is_near(double value, double target) {
  return std::abs(value - target) <= kAlike * std::abs(target);
}

class MotionWatch final : public Watch {
 public:
  explicit MotionWatch(const trace::Header& header)
      : up_(header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY()), up_name_(header.up) {}

  void see(const Solids& solids, const Moments& frames) override {
    see_densities(solids, frames);
    if (frames.after == nullptr) return;
    const double step = frames.after->time - frames.now->time;
    if (!(step > 0)) return;
    if (frames.before != nullptr) see_falls(solids, frames, step);
    see_rests(frames, step);
    see_drops(*frames.balance, frames);
  }

  void report(std::vector<Finding>& findings) override {
    report_axis(findings);
    if (report_time(findings)) return;
    report_unit(findings);
    report_densities(findings);
    report_impulses(findings);
  }

 private:
  static constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

  /// A crate of a ton and 1000 "metres" wide is in millimetres.
  void see_densities(const Solids& solids, const Moments& frames) {
    if (!frames.now->solver) return;
    for (const trace::Body& body : frames.now->solver->bodies) {
      const Solid* const solid = solids.find(body.name);
      if (solid == nullptr || solid->is_plane() || !(body.mass > 0) || !std::isfinite(body.mass))
        continue;
      const double volume = (solid->upper() - solid->lower()).prod();
      if (volume > 0)
        densities_.add(body.mass / volume, frames.now->line, frames.now->frame, body.name);
    }
  }

  /// A shape without contacts from the previous frame to the next is falling or flying.
  void see_falls(const Solids& solids, const Moments& frames, double step) {
    std::set<std::string> touched;
    for (const trace::Frame* frame : {frames.before, frames.now, frames.after})
      for (const trace::Pair& pair : frame->pairs)
        if (!pair.manifolds.empty())
          touched.insert(solids.body_of(pair.a)), touched.insert(solids.body_of(pair.b));
    for (const trace::Placement& one : frames.now->poses) {
      if (touched.contains(solids.body_of(one.first))) continue;
      const auto before = place(solids, frames.before, one.first, {});
      const auto now = place(solids, frames.now, one.first, {});
      const auto after = place(solids, frames.after, one.first, {});
      if (!before || !now || !after || now->solid->is_plane()) continue;
      const Vec3d bend = after->middle() - 2 * now->middle() + before->middle();
      const double moved = (after->middle() - before->middle()).norm();
      if (!(bend.norm() > 1e-6 * moved)) continue;  // straight line
      const Vec3d acceleration = bend / (step * step);
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(acceleration[axis]) < 0.95 * acceleration.norm()) continue;
        at(falls_, axis).add(acceleration[axis], frames.now->line, frames.now->frame, one.first);
      }
    }
  }

  /// Contacts of a resting body bear its weight.
  void see_rests(const Moments& frames, double step) {
    // The impulses lead from the velocities of one frame to those of the other.
    const trace::Frame* const other = frames.after_step ? frames.before : frames.after;
    if (!frames.now->solver || other == nullptr) return;
    for (const trace::Body& body : frames.now->solver->bodies) {
      const trace::Body* const after = trace::find_body(*other, body.name);
      if (after == nullptr || !(body.mass > 0) || !std::isfinite(body.mass)) continue;
      const double in_a_step = kGravity * step;  // velocity gained by gravity
      if (body.velocity.norm() > in_a_step ||
          (after->velocity - body.velocity).norm() > kAlike * in_a_step)
        continue;
      const Load* const load = known_load(frames.balance->now, body.name);
      if (load == nullptr) continue;
      const Vec3d weights = load->impulse / (body.mass * in_a_step);
      // The solver leaves sleeping bodies out.
      const Load* const earlier = known_load(frames.balance->before, body.name);
      if (weights.isZero() && body.velocity.isZero() && after->velocity.isZero() &&
          (earlier == nullptr || earlier->impulse.isZero()))
        continue;
      for (int axis = 0; axis < 3; ++axis)
        if (std::abs(weights[axis]) > 0.95 * weights.norm())
          at(rests_, axis).add(weights[axis], frames.now->line, frames.now->frame, body.name);
      weights_.add(weights.dot(up_), frames.now->line, frames.now->frame, body.name);
      const Balance::Missing* const missing = frames.balance->missing(body.name);
      const bool is_judged = missing && !missing->was_off;
      flicker_.of += !is_judged;
      if (!is_judged && jumps(frames, body, in_a_step))
        see_flicker(frames, body.name, load->impulse, earlier->impulse, 1);
      steps_ = frames.now->solver->substeps;
      step_ = step;
    }
  }

  /// The contacts of a body carry less or more than in the frame before, and its motion shows that
  /// this is not so; in the next frame it is as before. A force that is no contact's changes the
  /// motion instead, and a joint keeps what it takes over.
  void see_drops(const Balance& balance, const Moments& frames) {
    for (const auto& [body, one] : balance.all()) {
      flicker_.of += balance.missing(body) != nullptr;
      if (!balance.is_off(body)) continue;
      const Load *const then = known_load(balance.before, body), *const now =
                                                                     known_load(balance.now, body);
      const Load* const after = known_load(balance.after, body);
      if (then == nullptr || after == nullptr || one.was_off) continue;
      const Vec3d carried = now == nullptr ? Vec3d(Vec3d::Zero()) : now->impulse;
      constexpr double kAbout = 0.5, kLargeShare = 0.25;  // Bullet forgets a point now and then
      if ((then->impulse - carried - one.impulse).norm() > kAbout * one.impulse.norm()) continue;
      if ((after->impulse - then->impulse).norm() > kAbout * one.impulse.norm()) continue;
      see_flicker(frames, body, carried, then->impulse, one.share > kLargeShare ? one.share : 0);
    }
  }

  void see_flicker(const Moments& frames, const std::string& body, const Vec3d& now,
                   const Vec3d& then, double size) {
    flicker_.wrong_at({frames.now->frame, frames.now->line, body, ""}, frames, size, [&] {
      return std::pair("its contacts carry " + spelled(now) + " N s, and " + spelled(then) +
                           " N s in the frame before",
                       std::string("its motion shows no such change"));
    });
  }

  /// Whether the impulses on a body at rest are others for a frame. If they are not without points
  /// that are there twice, those are the fault.
  static bool jumps(const Moments& frames, const trace::Body& body, double in_a_step) {
    const Balance& balance = *frames.balance;
    const Load *const before = known_load(balance.before, body.name),
                      *const now = known_load(balance.now, body.name),
                      *const after = known_load(balance.after, body.name);
    const trace::Body* const earlier =
        frames.before == nullptr ? nullptr : trace::find_body(*frames.before, body.name);
    if (before == nullptr || after == nullptr || earlier == nullptr ||
        (body.velocity - earlier->velocity).norm() > kAlike * in_a_step)
      return false;
    constexpr double kMin = 0.7;  // less may go from one normal to another
    return std::ranges::all_of(std::array{&Load::impulse, &Load::once}, [&](auto impulse) {
      const Vec3d& then = before->*impulse;
      const double jump = (now->*impulse - then).norm();
      return jump > kMin * std::max((now->*impulse).norm(), then.norm()) &&
             (after->*impulse - then).norm() < jump / 4;
    });
  }

  void report_axis(std::vector<Finding>& findings) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (up_[axis] != 0) continue;
      const std::optional<double> fall = at(falls_, axis).common();
      const std::optional<double> rest = at(rests_, axis).common();
      const bool falls = fall && *fall < -0.5;
      const bool rests = rest && *rest > 0.1;
      const int along = up_name_ == "z" ? 2 : 1;
      if ((!falls && !rests) || at(falls_, along).count > 0 || at(rests_, along).count > 0)
        continue;
      const Samples& samples = at(falls ? falls_ : rests_, axis);
      findings.push_back(
          samples.finding("up_axis", std::string("up is ") + at(kAxes, axis) + ", not " + up_name_,
                          std::string("write \"up\":\"") + at(kAxes, axis) +
                              "\" in the header, or rotate the world",
                          "\"up\":\"" + up_name_ + "\"",
                          (falls ? "it falls along -" : "its contacts carry it along ") +
                              std::string(at(kAxes, axis))));
    }
  }

  /// Reports gravity and weights that fit a time that runs a thousand times too fast.
  bool report_time(std::vector<Finding>& findings) const {
    constexpr double kThousand = 1000;
    const std::optional<double> share = weights_.common();
    const bool bears = share && is_near(std::abs(*share), 1 / kThousand);
    const auto falls = std::ranges::find_if(falls_, [](const Samples& samples) {
      const std::optional<double> fall = samples.common();
      return fall && is_near(std::abs(*fall), kGravity / (kThousand * kThousand));
    });
    if (!bears && falls == falls_.end()) return false;
    const Samples& samples = bears ? weights_ : *falls;
    findings.push_back(samples.finding(
        "time_in_milliseconds", "'time' is in milliseconds", "divide it by 1000: it is in seconds",
        bears ? "its contacts carry " + shown(*share) + " of its weight"
              : "it falls with " + shown(std::abs(*falls->common())) + " per second squared",
        bears ? "it rests, so they carry all of it" : "it would be 9.81"));
    return true;
  }

  void report_unit(std::vector<Finding>& findings) const {
    for (const Samples& samples : falls_) {
      const std::optional<double> fall = samples.common();
      if (!fall) continue;
      for (const auto& [unit, factor] : kUnits) {
        if (!is_near(std::abs(*fall), factor * kGravity)) continue;
        findings.push_back(samples.of_unit(
            unit, factor, "it falls with " + shown(std::abs(*fall)) + " per second squared",
            "9.81"));
      }
    }
  }

  /// Reports a smaller unit of length in which all bodies have the density of a solid.
  void report_densities(std::vector<Finding>& findings) const {
    if (densities_.count == 0) return;
    constexpr double kLightest = 5, kHeaviest = 30'000;  // kg / m^3: foam, platinum
    for (const auto& [unit, factor] : kUnits) {
      const double cube = factor * factor * factor;
      if (cube * densities_.least < kLightest || cube * densities_.most > kHeaviest) continue;
      for (const Finding& finding : findings)
        if (finding.cause == std::string("world_in_") + unit) return;
      const double density = densities_.values.kept().front();
      findings.push_back(densities_.of_unit(
          unit, factor, "its box and mass give " + shown(density) + " kg per cubic metre",
          shown(cube * density)));
    }
  }

  void report_impulses(std::vector<Finding>& findings) const {
    constexpr double kShare = 1e-4;
    constexpr int kRepeats = 2;
    const std::optional<double> share = weights_.common();
    flicker_.report(findings, "impulses on bodies at rest come and go",
                    "check warm starting, and that the impulses of all points and of the last "
                    "iteration are written",
                    1, kShare, kRepeats);
    if (!share) return;
    const auto say = [&](const char* cause, const char* what, const char* remedy) {
      findings.push_back(weights_.finding(cause, what, remedy,
                                          "its contacts carry " + shown(*share) + " of its weight",
                                          "it rests, so they carry all of it"));
    };
    const struct {
      double share;
      const char *cause, *what, *remedy;
    } others[] = {
        {-1, "impulses_on_a", "impulses act on a", "negate them: an impulse acts on b"},
        {1 / step_, "impulses_are_forces", "impulses are forces, in newtons",
         "multiply each by the time of the step: an impulse is in newton seconds"},
        {steps_ > 1 ? 1.0 / steps_ : -1, "impulses_of_a_substep",
         "impulses are those of one sub-step",
         "sum those of all sub-steps: an impulse is over the whole step"},
        {0.5, "impulses_halved", "impulses carry half of the weight",
         "maybe the points of one of two manifolds are missing, or steps are counted as frames"},
        {2, "impulses_doubled", "impulses carry twice the weight",
         "maybe each is reported for both bodies, or added twice"}};
    for (const auto& [times, cause, what, remedy] : others)
      if (is_near(*share, times)) return say(cause, what, remedy);
    constexpr double kUnlike = 10;  // gravity may differ
    if (std::abs(*share) > kUnlike || std::abs(*share) < 1 / kUnlike)
      return say(
          "impulses_unlike_weights", "impulses do not match weights",
          "check 'mass' (kilograms, not its inverse) and the unit of impulses (newton seconds)");
  }

  Vec3d up_;
  std::string up_name_;
  std::array<Samples, 3> falls_, rests_;
  Samples weights_, densities_;
  Tally flicker_{"impulses_flicker", "poses"};
  int steps_ = 0;
  double step_ = 1;
};

}  // namespace

std::unique_ptr<Watch> watch_motion(const trace::Header& header) {
  return std::make_unique<MotionWatch>(header);
}

}  // namespace contactscope::lint
