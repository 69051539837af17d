#include "app/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace contactscope::app {
namespace {

TEST(Table, ColumnsAreAsWideAsATerminalShowsThem) {
  EXPECT_EQ(columns_of("crate"), 5u);
  EXPECT_EQ(columns_of("ящик"), 4u);
  EXPECT_EQ(columns_of("箱"), 2u);
  EXPECT_EQ(columns_of("📦"), 2u);
  EXPECT_EQ(columns_of("e\u0301tage"), 5u);
  std::ostringstream out;
  print({{"shape", "mass"}, {"ящик", "1"}, {"箱", "20"}}, out);
  EXPECT_EQ(out.str(), "shape  mass\nящик      1\n箱       20\n");
}

/// A study of curves with these parameters; the error equals the parameter.
trace::Study curves(const std::vector<double>& parameters) {
  trace::Study study;
  study.error = "way";
  study.unit = "m";
  study.parameter = "frame";
  study.form = trace::StudyForm::Curves;
  study.series = {{"pair", {}, "scene"}};
  for (const double parameter : parameters)
    study.series.back().points.push_back({parameter, parameter, parameter, {}, 0, 1});
  return study;
}

std::string table_of(const std::vector<double>& parameters) {
  std::ostringstream out;
  print_tables({curves(parameters)}, out);
  return out.str();
}

TEST(Table, CurvesHaveAColumnForAnyParameters) {
  EXPECT_EQ(
      table_of({16, 32}),
      "way (m): largest, by frame\nscene       16       32  failed\npair   1.6e+01  3.2e+01  0 "
      "of 2\n\n");
  EXPECT_EQ(table_of({0}).substr(0, 50), "way (m): largest, by frame\nscene        0  failed\n");
}

TEST(Table, ManyParametersShowDecadesOrASubset) {
  std::vector<double> halves, frames;
  for (int i = 0; i < 12; ++i) halves.push_back(std::pow(10.0, 0.5 * i));
  for (int i = 0; i < 33; ++i) frames.push_back(i);
  EXPECT_NE(
      table_of(halves).find("scene        1       10      100     1000    10000   100000   failed"),
      std::string::npos)
      << table_of(halves);
  EXPECT_NE(
      table_of(frames).find("scene        2        7       12       17       22       27       32"),
      std::string::npos)
      << table_of(frames);
}

}  // namespace
}  // namespace contactscope::app
