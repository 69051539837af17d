# The pipeline: the choice of features.
planted_bug(second_face_not_preferred FILE src/query/sat.cpp TESTS query
  WAS [[if (queries.separation(second) >= least) return second;]]
  IS [[if (!@BUG@ && queries.separation(second) >= least) return second;]])
planted_bug(no_preference FILE src/query/sat.cpp TESTS query
  WAS [[const S least = queries.separation(queries.deepest) - tolerance;]]
  IS [[const S least = queries.separation(queries.deepest) - (@BUG@ ? S(0) : tolerance);]])
planted_bug(deepest_face_of_b_is_of_a FILE src/query/sat.cpp TESTS query manifold
  WAS [[const bool is_of_b = result.face_b.separation > result.face_a.separation;]]
  IS [[const bool is_of_b = !@BUG@ && result.face_b.separation > result.face_a.separation;]])
planted_bug(face_ties_go_to_rounding FILE src/query/sat.cpp TESTS query
  WAS [[all.separation(f) > best.separation + tie)]]
  IS [[all.separation(f) > best.separation + (@BUG@ ? S(0) : tie))]])
planted_bug(last_face_left_out FILE src/query/sat.cpp TESTS query
  WAS [[for (int f = 1; f < reference.normals.count(); ++f) {]]
  IS [[for (int f = 1; f < reference.normals.count() - (@BUG@ ? 1 : 0); ++f) {]])
planted_bug(slip_of_parallel_edges_separates FILE src/query/query_edges.cpp TESTS query
  WAS [[if (sine < kNoisySine<S> || found.separation > S(0)) {]]
  IS [[if (!@BUG@ && (sine < kNoisySine<S> || found.separation > S(0))) {]])
planted_bug(first_edge_pair_wins FILE src/query/query_edges.cpp TESTS query
  WAS [[if (measure(pair, arc, along_a, edge_b, to_beat, best)) to_beat = best.separation + tie;]]
  IS [[if (!(@BUG@ && best.edge_a >= 0) && measure(pair, arc, along_a, edge_b, to_beat, best)) to_beat = best.separation + tie;]])
planted_bug(flat_hulls_pushed_together FILE src/query/query_edges.cpp TESTS query manifold
  WAS [[best = {across, edge, end.separation, -side};]]
  IS [[best = {across, edge, end.separation, Vec3<S>((@BUG@ ? S(1) : S(-1)) * side)};]])
planted_bug(gjk_normal_turned_round FILE src/query/gjk.cpp TESTS query
  WAS [[if (length > S(0)) result.normal = simplex.nearest.direction / length;]]
  IS [[if (length > S(0)) result.normal = simplex.nearest.direction / (@BUG@ ? -length : length);]])
planted_bug(gjk_last_step_not_told FILE src/query/gjk.cpp TESTS query
  WAS [[run->result = result;]]
  IS [[{ run->result = result; if (@BUG@ && run->steps.size() > 1) run->steps.pop_back(); }]])
planted_bug(epa_replaces_neighbours_only FILE src/query/polytope.cpp TESTS query
  WAS [[for (std::size_t i = 0; i < region.size(); ++i) {]]
  IS [[for (std::size_t i = 0; i < (@BUG@ ? std::size_t{1} : region.size()); ++i) {]])
planted_bug(epa_expands_any_face FILE src/query/polytope.cpp TESTS query
  WAS [[!candidate.is_closed && candidate.distance < least) {]]
  IS [[!candidate.is_closed && (@BUG@ || candidate.distance < least)) {]])
