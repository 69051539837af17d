/* An engine in C99, or in C++11, which has the recorder and nothing else of contactscope. */
#define CONTACTSCOPE_IMPLEMENTATION
#include "contactscope.h"

int main(void) {
  const double up[3] = {0, 1, 0}, zero[3] = {0, 0, 0}, unturned[4] = {1, 0, 0, 0};
  const double place[3] = {0, 0.48, 0};
  cs_point points[4];
  int i, ground, crate;
  cs_recorder* r = cs_start("run.jsonl", "mine/crate", "my engine", "1.0", NULL);
  if (!r) return 1;
  ground = cs_plane(r, "ground", up, 0.0);
  crate = cs_box(r, "crate", 0.5, 0.5, 0.5);
  memset(points, 0, sizeof points);
  for (i = 0; i < 4; ++i) {
    points[i].position[0] = i & 1 ? 0.5 : -0.5;
    points[i].position[1] = -0.02;
    points[i].position[2] = i & 2 ? 0.5 : -0.5;
    points[i].separation = -0.02;
  }
  cs_begin_frame(r, 0.0);
  cs_pose(r, ground, zero, unturned);
  cs_pose(r, crate, place, unturned);
  cs_manifold(r, ground, crate, up, -1, points, 4);
  cs_end_frame(r);
  i = cs_failure(r) != NULL;
  cs_stop(r);
  return i;
}
