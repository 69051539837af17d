#include "geometry/qhull_oracle.h"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace contactscope::test {

QhullAnswer run_qhull(const std::vector<Vec3d>& points) {
  std::vector<coordT> coordinates;
  for (const Vec3d& point : points)
    coordinates.insert(coordinates.end(), point.data(), point.data() + 3);
  char command[] = "qhull ";
  qhT state;
  qhT* qh = &state;
  qh_zero(qh, stderr);
  const int status = qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(), False,
                                  command, nullptr, nullptr);
  if (status != 0) throw std::runtime_error("libqhull failed on the test's points");
  qh_getarea(qh, qh->facet_list);
  QhullAnswer answer;
  answer.volume = qh->totvol;
  answer.area = qh->totarea;
  vertexT* vertex = nullptr;
  FORALLvertices { answer.vertices.push_back(qh_pointid(qh, vertex->point)); }
  std::sort(answer.vertices.begin(), answer.vertices.end());
  qh_freeqhull(qh, qh_ALL);
  int long_count = 0;
  int long_bytes = 0;
  qh_memfreeshort(qh, &long_count, &long_bytes);
  return answer;
}

}  // namespace contactscope::test
