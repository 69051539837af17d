#include "shrink/shrink.h"

#include "find/finder.h"
#include "scenario/run.h"
#include "versus/comparison.h"
#include "versus/request.h"

namespace contactscope::shrink {
namespace {

constexpr const char* kPath = "shrink/pair.toml";

PairOfTwo with_scalar(PairOfTwo pair, const std::string& scalar) {
  std::erase_if(pair.settings, [](const Setting& setting) { return setting.first == "scalar"; });
  pair.settings.emplace_back("scalar", quoted(scalar));
  return pair;
}

/// The claims of a pair as in the engine's trace, in the frame of a.
trace::Pair claimed(const PairOfTwo& pair) {
  trace::Pair record;
  record.a = pair.a.name;
  record.b = pair.b.name;
  record.manifolds = *pair.claims;
  record.state = record.manifolds.empty() ? "separated" : "touching";
  record.separation = record.manifolds.empty() ? 0 : std::numeric_limits<double>::infinity();
  const Pose<double> pose = pair.a.pose();
  for (trace::Manifold& manifold : record.manifolds) {
    manifold.normal = pose.rotate(manifold.normal);
    for (trace::Point& point : manifold.points) {
      point.position = pose.transform(point.position);
      record.separation = std::min(record.separation, point.separation);
    }
  }
  return record;
}

std::string spelled_claims(const PairOfTwo& pair) {
  std::string text;
  if (!pair.claims) return text;
  for (const trace::Manifold& manifold : *pair.claims) {
    text += "\n" + spell(manifold.normal);
    for (const trace::Point& point : manifold.points)
      text += " " + spell(point.position) + spell(point.separation);
  }
  return text;
}

/// The result of running a scenario once.
struct Run {
  explicit Run(const PairOfTwo& pair, const trace::Stages& stages = trace::Stages::none())
      : scenario(parse_scenario(to_scenario(pair, "", ""), kPath)) {
    Runner runner(scenario, stages);
    trace.header = runner.header();
    trace.frames.push_back(runner.frame(0));
  }
  const trace::Pair& pair() const { return trace.frames.front().pairs.front(); }

  Scenario scenario;
  trace::Trace trace;
};

find::Value quantity_of(const trace::Pair& pair, const std::string& quantity) {
  // Here the answer of a query, since pairs with one have no points.
  if (quantity == "overlap") return pair.overlap ? double(*pair.overlap) : find::kUnknown;
  return find::value_of({&pair}, quantity);
}

double lint_of(const trace::Trace& trace, const std::string& cause) {
  double found = 0;
  for (const lint::Finding& finding : lint::lint(trace))
    if (cause.empty() || finding.cause == cause) found += std::max(finding.count, 1);
  return found;
}

/// The part of a sentence that rounding does not change: all of it for counts, else only words.
std::string unmet_words(const std::string& sentence) {
  const std::size_t at = sentence.find("expected ");
  std::string words = at == std::string::npos ? sentence : sentence.substr(at);
  if (words.find(" point") != std::string::npos) return words;
  std::erase_if(words, [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
  });
  return words;
}

std::vector<std::string> unmet_of(const Run& run) {
  return mapped(unmet_expectations(run.scenario, run.trace.frames), unmet_words);
}

}  // namespace

const find::Vocabulary& vocabulary() {
  static const find::Vocabulary known = [] {
    const auto& all = find::pair_quantities();
    find::Vocabulary names{
        {all.begin(), all.begin() + find::kOfPairAlone}, {}, {"lint", "unmet"}, lint::causes()};
    std::ranges::find(names.quantities, "overlap", &find::Quantity::name)->unit = find::Unit::Count;
    return names;
  }();
  return known;
}

std::optional<trace::Pair> Judge::in_double(const PairOfTwo& pair) {
  try {
    return Run(with_scalar(pair, "double")).pair();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

trace::Trace Judge::trace_of(const PairOfTwo& pair) {
  trace::Stages stages = trace::Stages::none();
  stages.reduction = true;  // shows whether a point was dropped on purpose
  trace::Trace trace = Run(pair, stages).trace;
  if (pair.claims) {
    trace.header.engine = "recorded";
    trace.frames.front().pairs = {claimed(pair)};
  }
  return trace;
}

void Judge::remember_unmet(const PairOfTwo& pair) { unmet_ = unmet_of(Run(pair)); }

bool Judge::holds(const PairOfTwo& pair) {
  const std::string text = to_scenario(pair, "", "");
  const std::string key = text + spelled_claims(pair);
  const auto [known, is_new] = known_.emplace(key, false);
  if (!is_new) return known->second;
  ++queries_;
  std::map<std::string, trace::Pair> record;
  const auto report = [&](const std::string& side) -> const trace::Pair& {
    const auto found = record.find(side);
    if (found != record.end()) return found->second;
    trace::Pair answer;
    if (side == "float" || side == "double") {
      answer = Run(with_scalar(pair, side)).pair();
    } else if (side == "recorded" || (side.empty() && pair.claims)) {
      if (pair.claims) answer = claimed(pair);
    } else if (side.empty()) {
      answer = Run(pair).pair();
    } else {
      const trace::Trace request = versus::request_of(Run(pair).trace);
      const trace::Trace answered = engines_.at(side)(request);
      const auto found_pair = answered.frames.empty() ? std::nullopt
                                                      : versus::pair_of(answered.frames.front(),
                                                                        pair.a.name, pair.b.name);
      if (found_pair) answer = *found_pair;
      if (!found_pair) answer.state = "separated";
      answer.separation =
          answer.manifolds.empty() ? find::kUnknown : std::numeric_limits<double>::infinity();
      for (const trace::Point& point : joined(answer.manifolds, &trace::Manifold::points))
        answer.separation = std::min(answer.separation, point.separation);
      if (!answer.manifolds.empty()) answer.state = "touching";
    }
    return record.emplace(side, std::move(answer)).first->second;
  };
  try {
    // Reject new warnings: a hull must not become flat, which is another kind of pair.
    const std::size_t warnings = Run(pair).scenario.warnings.size();
    if (warnings > warnings_.value_or(warnings)) return false;
    const bool holds = expression_.holds([&](const std::string& side, const std::string& quantity) {
      if (side == "lint") return find::Value(lint_of(trace_of(pair), quantity));
      if (side == "unmet") {
        const std::vector<std::string> unmet = unmet_of(Run(pair));
        return find::Value(unmet_ && unmet != *unmet_ ? 0.0 : double(unmet.size()));
      }
      return quantity_of(report(side), quantity);
    });
    if (holds && !warnings_) warnings_ = warnings;
    return known_[key] = holds;
  } catch (const InputError&) {  // not a valid scenario
    return false;
  } catch (const ShapeError&) {
    return false;
  }
}

}  // namespace contactscope::shrink
