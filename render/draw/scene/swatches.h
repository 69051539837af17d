#pragma once

#include "draw/scene/sketch.h"
#include "trace/trace.h"

/// Swatches of signs that several drawings share: the same thing looks the same in a view, in the
/// contact plane and in an inset. The others stand in the file of the one drawing that they are of.
namespace contactscope::draw {

inline constexpr Swatch kReferenceFaceSwatch{
    LegendGroup::Faces, 0,
    [](auto& pen) { pen.box(with_alpha(kReferenceFace, 0.35f), kReferenceFace, 2.5); }};
inline constexpr Swatch kIncidentFaceSwatch{
    LegendGroup::Faces, 2,
    [](auto& pen) { pen.box(with_alpha(kIncidentFace, 0.35f), kIncidentFace, 2.5, true); }};
inline constexpr Swatch kClipPolygonSwatch{
    LegendGroup::Faces, 3,
    [](auto& pen) { pen.box(with_alpha(kClipPolygon, 0.2f), kClipPolygon, 2.5); }};
inline constexpr Swatch kSupportSwatch{
    LegendGroup::Faces, 4,
    [](auto& pen) { pen.box(with_alpha(kClipPolygon, 0.28f), kClipPolygon, 2.5); }};

inline constexpr Swatch kDroppedSwatch{LegendGroup::Points, 0,
                                       [](auto& pen) { pen.crossed(kDropped); }};
inline constexpr Swatch kReducedSwatch{LegendGroup::Points, 1,
                                       [](auto& pen) { pen.crossed(kDropped); }};
inline constexpr Swatch kContactSwatch{LegendGroup::Points, 3, [](auto& pen) {
                                         pen.whisker(2.5, kContact);
                                         pen.dot(0, 4.8, kContact);
                                       }};
inline constexpr Swatch kPlainPointSwatch{LegendGroup::Points, 9,
                                          [](auto& pen) { pen.dot(0, 4.8, kContact); }};
inline constexpr Swatch kKeptSwatch{LegendGroup::Points, 11, [](auto& pen) {
                                      pen.dot(0, 3.6, kContact);
                                      pen.dot(6.2, 8.2, kContact);
                                    }};

inline constexpr Swatch kFreeAxisSwatch{LegendGroup::Masses, 1,
                                        [](auto& pen) { pen.dashes(2.5, kNormal); }};

/// What a body stands on, and the axis about which it turns where it is not stable.
inline void explain_support(const trace::Stability& stability, bool turns, Legend& legend) {
  if (stability.support.size() > 2)
    legend.explain(kSupportSwatch, "support: hull of the contact points");
  if (stability.support.size() == 2)
    legend.explain(kSupportSwatch, "support: a line between two points");
  if (turns) legend.explain(kFreeAxisSwatch, "axis about which the body turns");
}

inline constexpr Swatch kDecidingEdgesSwatch{LegendGroup::Axes, 0,
                                             [](auto& pen) { pen.level_line(0, 22, 4, kAxis); }};
inline constexpr Swatch kAxisSwatch{LegendGroup::Axes, 1, [](auto& pen) {
                                      pen.level_line(6, 16, 3, kAxis);
                                      pen.head(22, 8, kAxis);
                                      pen.head(0, -8, kAxis);
                                    }};
/// Of a measure that is too narrow for its arrow.
inline constexpr Swatch kNarrowAxisSwatch{LegendGroup::Axes, 2, [](auto& pen) {
                                            pen.level_line(0, 3, 3, kAxis);
                                            pen.head(10, 8, kAxis);
                                            pen.level_line(19, 22, 3, kAxis);
                                            pen.head(12, -8, kAxis);
                                          }};

}  // namespace contactscope::draw
