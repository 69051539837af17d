#pragma once

#include "geometry/shape.h"
#include "image/image.h"
#include "package/contactscope/render.h"
#include "trace/json.h"

/// Conversions between the package's plain data and the library's types. In the package, the
/// library's types have qualified names: contactscope::Manifold<double>.
namespace contactscope::package {

struct Trace::Facts {
  contactscope::trace::Trace trace;
  int cut_off_in = 0;  // line of the file; 0: the file is complete
};

struct Collider::Built {
  contactscope::Shape<double> in_double;
  contactscope::Shape<float> in_float;  // each coordinate rounded once
  const char* type;                     // "box", "hull", ... as in traces
};

template <class S> const contactscope::Shape<S>& shape_in(const Collider::Built& built) {
  if constexpr (std::is_same_v<S, float>) return built.in_float;
  if constexpr (std::is_same_v<S, double>) return built.in_double;
}

Vec3d to_inside(const Vec3& vector);
Vec3 to_outside(const Vec3d& vector);

/// Normalizes the quaternion, unless its length is zero or not finite.
contactscope::Pose<double> to_inside(const Pose& pose);
Pose to_outside(const contactscope::Pose<double>& pose);

contactscope::trace::Manifold to_inside(const Manifold& manifold);
Manifold to_outside(const contactscope::trace::Manifold& manifold);

/// Separation of the deepest point of all in metres, negative = overlap; 0 without points.
double separation_of(const std::vector<Manifold>& manifolds);

/// A shape as in traces, with the vertices that a pipeline with this scalar sees.
contactscope::trace::Shape traced(const std::string& name, const Collider& collider, Scalar scalar);

Trace trace_of(contactscope::trace::Trace facts);

/// "float" or "double", as in traces.
const char* name_of(Scalar scalar);

/// Throws std::invalid_argument: "there is no layer 'shape'; did you mean 'shapes'? there is ...".
[[noreturn]] void refuse(const std::string& what, const std::string& word,
                         const std::vector<std::string_view>& known);

/// Draws the frames with the indices `which`, with the camera fitted to the frames `fitted`, and
/// passes each picture to `take`. Throws as render() does.
void draw_frames(const contactscope::trace::Header& header,
                 const std::vector<contactscope::trace::Frame>& fitted,
                 const std::vector<contactscope::trace::Frame>& frames,
                 const std::vector<std::size_t>& which, const RenderOptions& options,
                 const std::function<void(std::size_t, Image)>& take);

}  // namespace contactscope::package
