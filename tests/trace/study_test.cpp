#include "trace/study.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace contactscope::trace {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Study sample_study() {
  Study study;
  study.study = "reducers";
  study.measure = "area";
  study.title = "What each reducer loses";
  study.context = {"Some \"fast\" CPU, 2 cores", "GCC 12", "Release", "2026-01-02T03:04:05Z",
                   "float"};
  study.reference = "the best, by brute force";
  study.error = "lost area";
  study.unit = "";
  study.parameter = "points";
  StudyPoint good{5, 0.1, 1.0 / 3.0, {100.25, 99, 180}, 0, 20};
  StudyPoint some_failed{6, 0.0, 1e-300, {1e5, 2, 1e6}, 7, 20};
  StudyPoint all_failed{8, std::nullopt, std::nullopt, {3, 2, 4}, 20, 20};
  study.series = {{"area", {good, some_failed}}, {"broken", {all_failed}}};
  return study;
}

std::vector<std::string> keys(const nlohmann::ordered_json& json) {
  std::vector<std::string> names;
  for (const auto& [key, value] : json.items()) names.push_back(key);
  return names;
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

TEST(StudyJson, HasTheKeysOfTheFormat) {
  const auto json = nlohmann::ordered_json::parse(to_json(sample_study()));
  EXPECT_EQ(json["schema"], "contactscope.study/1");
  EXPECT_EQ(json["study"], "reducers");
  EXPECT_EQ(json["reference"], "the best, by brute force");
  EXPECT_EQ(json["error"], "lost area");
  EXPECT_EQ(json["context"]["cpu"], "Some \"fast\" CPU, 2 cores");
  EXPECT_EQ(json["context"]["compiler"], "GCC 12");
  EXPECT_EQ(json["context"]["build_type"], "Release");
  EXPECT_EQ(json["context"]["date"], "2026-01-02T03:04:05Z");
  ASSERT_EQ(json["series"].size(), 2u);
  EXPECT_THAT(keys(json["series"][0]), ElementsAre("method", "points"));
  const auto& point = json["series"][0]["points"][0];
  EXPECT_THAT(keys(point),
              ElementsAre("parameter", "error", "error_worst", "nanoseconds", "failed", "of"));
  EXPECT_THAT(keys(point["nanoseconds"]), ElementsAre("median", "min", "max"));
}

TEST(StudyJson, NumbersReadBackToTheSameDouble) {
  const auto json = nlohmann::json::parse(to_json(sample_study()));
  const auto& points = json["series"][0]["points"];
  EXPECT_EQ(points[0]["error"].get<double>(), 0.1);
  EXPECT_EQ(points[0]["error_worst"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(points[1]["error_worst"].get<double>(), 1e-300);
  EXPECT_EQ(points[0]["nanoseconds"]["median"].get<double>(), 100.25);
}

TEST(StudyJson, FailuresAreKeptAlsoWhereNothingElseIsLeft) {
  const auto json = nlohmann::json::parse(to_json(sample_study()));
  EXPECT_EQ(json["series"][0]["points"][1]["failed"], 7);
  const auto& broken = json["series"][1]["points"][0];
  EXPECT_EQ(broken["failed"], 20);
  EXPECT_EQ(broken["of"], 20);
  EXPECT_TRUE(broken["error"].is_null());
  EXPECT_TRUE(broken["error_worst"].is_null());
}

TEST(StudyCsv, HoldsALineAPointUnderOneHeader) {
  const std::vector<std::string> rows = lines(to_csv(sample_study()));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_THAT(rows[0], HasSubstr("study,measure,method,parameter,error,error_worst,"
                                 "nanoseconds_median,nanoseconds_min,nanoseconds_max,failed,of,"));
  EXPECT_THAT(rows[1],
              HasSubstr("reducers,area,area,5,0.1,0.3333333333333333,100.25,99,180,0,20,"));
  EXPECT_THAT(rows[3], HasSubstr("reducers,area,broken,8,,,3,2,4,20,20,"));
}

TEST(StudyCsv, QuotesWhatHoldsCommasAndQuotes) {
  const std::string text = to_csv(sample_study());
  EXPECT_THAT(text, HasSubstr(",\"Some \"\"fast\"\" CPU, 2 cores\","));
  EXPECT_THAT(text, HasSubstr(",\"the best, by brute force\","));
  EXPECT_THAT(text, HasSubstr(",GCC 12,Release,2026-01-02T03:04:05Z,float\n"));
}

TEST(StudyJson, CurvesAndMapsHaveThePlacesOfTheirSeries) {
  Study study = sample_study();
  study.form = StudyForm::Map;
  study.row = "size (m)";
  study.signal = "overlap";
  study.series[0].panel = "float";
  study.series[0].parameter = "tilt (rad)";
  study.series[0].row = 0.001;
  const auto json = nlohmann::ordered_json::parse(to_json(study));
  EXPECT_EQ(json["form"], "map");
  EXPECT_EQ(json["row"], "size (m)");
  EXPECT_EQ(json["signal"], "overlap");
  EXPECT_THAT(keys(json["series"][0]),
              ElementsAre("method", "panel", "parameter", "row", "points"));
  EXPECT_EQ(json["series"][0]["panel"], "float");
  EXPECT_EQ(json["series"][0]["row"].get<double>(), 0.001);
  EXPECT_TRUE(json["series"][1]["row"].is_null());
  const std::vector<std::string> rows = lines(to_csv(study));
  EXPECT_THAT(rows[0], testing::EndsWith(",scalar,panel,row_name,row"));
  EXPECT_THAT(rows[1], testing::EndsWith(",float,float,size (m),0.001"));
  EXPECT_THAT(rows[1], HasSubstr(",tilt (rad),"));
  EXPECT_THAT(rows[3], testing::EndsWith(",float,,size (m),"));
}

TEST(StudyJson, WorkPrecisionInPanelsHasThePanelOfEachSeries) {
  Study study = sample_study();
  EXPECT_FALSE(has_panels(study));
  study.series[1].panel = "sub-steps";
  EXPECT_TRUE(has_panels(study));
  const auto json = nlohmann::ordered_json::parse(to_json(study));
  EXPECT_EQ(json["form"], "work_precision");
  EXPECT_EQ(json["series"][0]["panel"], "");
  EXPECT_EQ(json["series"][1]["panel"], "sub-steps");
  EXPECT_THAT(lines(to_csv(study)).back(), testing::EndsWith(",sub-steps,,"));
}

TEST(Study, NumbersThatAreNotFiniteAreRefusedByName) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Study study = sample_study();
    study.series[0].points[0].nanoseconds.max = bad;
    EXPECT_THROW(to_csv(study), std::domain_error);
    try {
      to_json(study);
      ADD_FAILURE() << "accepted " << bad;
    } catch (const std::domain_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("'max'"));
    }
  }
}

}  // namespace
}  // namespace contactscope::trace
