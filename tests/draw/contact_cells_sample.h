#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "draw/drawn_texts.h"
#include "draw/insets/contact_cells.h"
#include "image/font.h"

/// Sample cells of contact points, and helpers that examine their drawings.
namespace contactscope::draw {

/// An octagon with depths, on the floor.
inline std::vector<trace::Point> octagon(double shift = 0) {
  std::vector<trace::Point> points;
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.3 + i * 0.7853981633974483;
    points.push_back({Vec3d(shift + 2 * std::cos(angle), 0, std::sin(angle)), -0.001 * (i + 1),
                      "a:e" + std::to_string(i) + " b:e1"});
  }
  return points;
}

inline ContactCell cell_of(const std::string& name, std::vector<trace::Point> points) {
  ContactCell cell;
  cell.name = name;
  cell.normal = Vec3d::UnitY();
  cell.points = std::move(points);
  if (cell.points.size() > 6) {
    cell.kept = {1, 5, 3, 0};
    cell.best = {0, 2, 4, 6};
  } else {
    for (int i = 0; i < static_cast<int>(cell.points.size()); ++i) cell.kept.push_back(i);
  }
  cell.rows = {{"area 99.954 %", "1234 ns", "area 99.954 %", false},
               {"moments −12.3 %", "", "mom. −12 %", false},
               {"deepest lost, tips over", "", "lost, tips over", true}};
  return cell;
}

inline std::vector<ContactMoment> moments_of(int cells, int frames) {
  std::vector<ContactMoment> moments;
  for (int f = 0; f < frames; ++f) {
    ContactMoment moment;
    moment.frame = f;
    moment.caption = "crate and floor, frame " + std::to_string(f);
    for (int c = 0; c < cells; ++c) {
      moment.cells.push_back(cell_of("reducer_" + std::to_string(c), octagon(0.01 * f)));
    }
    moments.push_back(moment);
  }
  return moments;
}

inline Drawing drawn(const std::vector<ContactMoment>& moments, int frame, int width = 1280,
                     int height = 720, int choices = 0) {
  return ContactCells("A crate on a floor", "Gregorius 2015", "y", moments, choices, width, height)
      .frame(frame);
}

template <class T> std::vector<T> all(const Drawing& drawing) {
  std::vector<T> list;
  for (const Primitive& primitive : drawing.primitives) {
    if (const T* one = std::get_if<T>(&primitive)) list.push_back(*one);
  }
  return list;
}

inline Rect box_of(const Text& text) {
  const FontWeight weight = text.weight == Weight::Bold ? FontWeight::Bold : FontWeight::Regular;
  const double width = text_width(text.text, text.size, weight);
  const double share = text.align == Align::Left ? 0 : text.align == Align::Center ? 0.5 : 1;
  return {text.at.x - share * width, text.at.y - 0.62 * text.size, width, 0.75 * text.size};
}

/// The rings of kept points, without those around the numbers of their badges.
inline std::vector<Disc> rings(const Drawing& drawing) {
  const std::vector<Text> words = all<Text>(drawing);
  std::vector<Disc> list;
  for (const Disc& disc : all<Disc>(drawing)) {
    const auto is_in_it = [&](const Text& text) {
      return box_of(text).contains(disc.center) && text.text.size() <= 2;
    };
    if (disc.inner > 0 && std::ranges::none_of(words, is_in_it)) list.push_back(disc);
  }
  return list;
}

/// The corners of a primitive's bounds, including NaN.
inline std::vector<Point2> places(const Primitive& primitive) {
  if (const Fill* fill = std::get_if<Fill>(&primitive)) return fill->polygon;
  if (const Stroke* s = std::get_if<Stroke>(&primitive)) return {s->from, s->to};
  if (const Disc* d = std::get_if<Disc>(&primitive)) {
    return {{d->center.x - d->outer, d->center.y - d->outer},
            {d->center.x + d->outer, d->center.y + d->outer}};
  }
  const Rect box = box_of(std::get<Text>(primitive));
  return {{static_cast<float>(box.x), static_cast<float>(box.y)},
          {static_cast<float>(box.x + box.width), static_cast<float>(box.y + box.height)}};
}

/// Fails if anything is painted outside the canvas or at NaN.
inline void expect_on_canvas(const Drawing& drawing, const std::string& what) {
  int outside = 0;
  std::string first;
  for (const Primitive& primitive : drawing.primitives) {
    for (const Point2& p : places(primitive)) {
      // NaN fails every comparison.
      const bool in = p.x >= -0.5f && p.y >= -0.5f && p.x <= drawing.width + 0.5f &&
                      p.y <= drawing.height + 0.5f;
      if (in) continue;
      if (outside++ > 0) continue;
      const Text* text = std::get_if<Text>(&primitive);
      first = (text ? text->text : "kind " + std::to_string(primitive.index())) + " at " +
              std::to_string(p.x) + ", " + std::to_string(p.y);
    }
  }
  EXPECT_EQ(outside, 0) << what << ": first " << first;
}

}  // namespace contactscope::draw
