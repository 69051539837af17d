# Sixty bugs as they are made: a sign, an index, a limit, a case that was forgotten. @BUG@ holds where the bug is switched
# on. TESTS are the folders whose tests should notice; where none is named, `check` should.

# The pipeline: which feature touches.
planted_bug(second_face_not_preferred FILE src/query/sat.cpp TESTS query
  WAS [[if (queries.separation(second) >= least) return second;]]
  IS [[if (!@BUG@ && queries.separation(second) >= least) return second;]])
planted_bug(no_preference FILE src/query/sat.cpp TESTS query
  WAS [[const S least = queries.separation(queries.deepest) - tolerance;]]
  IS [[const S least = queries.separation(queries.deepest) - (@BUG@ ? S(0) : tolerance);]])
planted_bug(deepest_face_of_b_is_of_a FILE src/query/sat.cpp TESTS query manifold
  WAS [[const bool is_of_b = result.face_b.separation > result.face_a.separation;]]
  IS [[const bool is_of_b = !@BUG@ && result.face_b.separation > result.face_a.separation;]])
planted_bug(face_ties_go_to_rounding FILE src/query/query_faces.cpp TESTS query
  WAS [[all.separation(f) > best.separation + tie)]]
  IS [[all.separation(f) > best.separation + (@BUG@ ? S(0) : tie))]])
planted_bug(last_face_left_out FILE src/query/query_faces.cpp TESTS query
  WAS [[for (int f = 1; f < reference.normals.count(); ++f) {]]
  IS [[for (int f = 1; f < reference.normals.count() - (@BUG@ ? 1 : 0); ++f) {]])
planted_bug(edge_normal_of_wide_arcs_only FILE src/query/query_edges.cpp TESTS query
  WAS [[return wide || cross.dot(Vec3<S>(first + second)) >= S(0) ? S(1) : S(-1);]]
  IS [[return wide || @BUG@ || cross.dot(Vec3<S>(first + second)) >= S(0) ? S(1) : S(-1);]])
planted_bug(first_edge_pair_wins FILE src/query/query_edges.cpp TESTS query
  WAS [[if (measure(pair, arc, along_a, edge_b, to_beat, best)) to_beat = best.separation + tie;]]
  IS [[if (!(@BUG@ && best.edge_a >= 0) && measure(pair, arc, along_a, edge_b, to_beat, best)) to_beat = best.separation + tie;]])
planted_bug(flat_hulls_pushed_together FILE src/query/query_edges.cpp TESTS query manifold
  WAS [[best = {across, edge, end.separation, -side};]]
  IS [[best = {across, edge, end.separation, Vec3<S>((@BUG@ ? S(1) : S(-1)) * side)};]])
planted_bug(gjk_normal_turned_round FILE src/query/gjk.cpp TESTS query
  WAS [[if (length > S(0)) result.normal = simplex.nearest.direction / length;]]
  IS [[if (length > S(0)) result.normal = simplex.nearest.direction / (@BUG@ ? -length : length);]])
planted_bug(gjk_last_step_not_told FILE src/query/gjk.cpp TESTS manifold
  WAS [[run->result = result;]]
  IS [[{ run->result = result; if (@BUG@ && run->steps.size() > 1) run->steps.pop_back(); }]])
planted_bug(epa_keeps_coplanar_faces FILE src/query/polytope.cpp TESTS query
  WAS [[candidate.offset > -rounding_;]]
  IS [[candidate.offset > (@BUG@ ? rounding_ : -rounding_);]])
planted_bug(epa_expands_any_face FILE src/query/polytope.cpp TESTS query
  WAS [[!candidate.is_closed && candidate.distance < least) {]]
  IS [[!candidate.is_closed && (@BUG@ || candidate.distance < least)) {]])

# The pipeline: points.
planted_bug(most_parallel_incident_face FILE src/manifold/face_contact.cpp TESTS manifold
  WAS [[const S along = reference_normal.dot(hull.normal(face));]]
  IS [[const S along = (@BUG@ ? S(-1) : S(1)) * reference_normal.dot(hull.normal(face));]])
planted_bug(normal_of_b_not_turned FILE src/manifold/face_contact.cpp TESTS manifold
  WAS [[contact.normal = reference == Owner::A ? plane.normal : Vec3<S>(-plane.normal);]]
  IS [[contact.normal = reference == Owner::A || @BUG@ ? plane.normal : Vec3<S>(-plane.normal);]])
planted_bug(points_halfway_to_the_reference_face FILE src/manifold/face_contact.cpp TESTS manifold
  WAS [[const Vec3<S> moved = vertex.position - separation * plane.normal;]]
  IS [[const Vec3<S> moved = vertex.position - (@BUG@ ? S(0.5) : S(1)) * separation * plane.normal;]])
planted_bug(margin_forgotten_when_clipping FILE src/manifold/face_contact.cpp TESTS manifold
  WAS [[if (separation <= margin) {]]
  IS [[if (separation <= (@BUG@ ? S(0) : margin)) {]])
planted_bug(empty_face_contact FILE src/manifold/create_contact.cpp TESTS manifold
  WAS [[if (axis == axes.deepest) {]]
  IS [[if (!@BUG@ && axis == axes.deepest) {]])
planted_bug(edge_point_on_a FILE src/manifold/edge_contact.h TESTS manifold
  WAS [[const Vec3<S> middle = S(0.5) * (closest.on_a + closest.on_b);]]
  IS [[const Vec3<S> middle = @BUG@ ? closest.on_a : Vec3<S>(S(0.5) * (closest.on_a + closest.on_b));]])
planted_bug(edge_id_of_half_edges FILE src/manifold/edge_contact.h TESTS manifold
  WAS [[edge_ref(Owner::B, query.edge_b / 2));]]
  IS [[edge_ref(Owner::B, @BUG@ ? query.edge_b : query.edge_b / 2));]])
planted_bug(clip_between_wrong_distances FILE src/manifold/clip.cpp TESTS manifold
  WAS [[const S fraction = p_distance / (p_distance - q_distance);]]
  IS [[const S fraction = @BUG@ ? S(0.5) : p_distance / (p_distance - q_distance);]])
planted_bug(clip_ids_of_the_edge_before FILE src/manifold/clip.cpp TESTS manifold
  WAS [[Crossing::of(p.leaving, side_edge)});]]
  IS [[Crossing::of(@BUG@ ? polygon[next].leaving : p.leaving, side_edge)});]])
planted_bug(clip_names_the_way_back_wrong FILE src/manifold/clip.cpp TESTS manifold
  WAS [[{crossing, p_inside ? side_edge : p.leaving, ]]
  IS [[{crossing, p_inside || @BUG@ ? side_edge : p.leaving, ]])
planted_bug(fallback_normal_does_not_turn FILE src/manifold/collide_sphere_sphere.cpp TESTS manifold
  WAS [[contact.normal = b_in_a.rotate(Vec3<S>::UnitY());]]
  IS [[contact.normal = @BUG@ ? Vec3<S>(Vec3<S>::UnitY()) : b_in_a.rotate(Vec3<S>::UnitY());]])
planted_bug(crossing_capsules_pulled_together FILE src/manifold/collide_capsule_capsule.cpp TESTS manifold
  WAS [[return normal.dot(between) < S(0) ? Vec3<S>(-normal) : normal;]]
  IS [[return !@BUG@ && normal.dot(between) < S(0) ? Vec3<S>(-normal) : normal;]])
planted_bug(antiparallel_capsules_pair_the_same_ends FILE src/manifold/collide_capsule_capsule.cpp TESTS manifold
  WAS [[const bool same_way = axes.a.along.dot(axes.b.along) > S(0);]]
  IS [[const bool same_way = @BUG@ || axes.a.along.dot(axes.b.along) > S(0);]])
planted_bug(one_point_for_two FILE src/manifold/collide_capsule_capsule.cpp TESTS manifold
  WAS [[for (int side = 0; side < 2; ++side) {]]
  IS [[for (int side = 0; side < (@BUG@ ? 1 : 2); ++side) {]])
planted_bug(ball_point_beside_the_hull FILE src/manifold/collide_sphere_hull.cpp TESTS manifold
  WAS [[const Vec3<S> position = touch.distance * contact.normal;]]
  IS [[const Vec3<S> position = (@BUG@ ? separation : touch.distance) * contact.normal;]])
planted_bug(plane_points_halfway FILE src/manifold/collide_with_plane.cpp TESTS manifold
  WAS [[return {core - height * plane.normal, height - radius, id};]]
  IS [[return {core - (@BUG@ ? S(0.5) : S(1)) * height * plane.normal, height - radius, id};]])
planted_bug(corners_within_the_margin_lost FILE src/manifold/collide_with_plane.cpp TESTS manifold
  WAS [[if (height > options.margin) continue;]]
  IS [[if (height > (@BUG@ ? 0 : options.margin)) continue;]])
planted_bug(back_of_a_triangle_is_its_front FILE src/manifold/collide_with_mesh.cpp TESTS manifold
  WAS [[const int face = height >= -touching ? 0 : 1;]]
  IS [[const int face = height >= -touching || @BUG@ ? 0 : 1;]])
planted_bug(last_edge_of_a_triangle FILE src/manifold/collide_with_mesh.cpp TESTS manifold
  WAS [[if (!(squared < least)) continue;]]
  IS [[if (!@BUG@ && !(squared < least)) continue;]])
planted_bug(cache_never_gives_up FILE src/manifold/pair_cache.cpp TESTS manifold
  WAS [[return bound <= margin && bound - separation <= tolerance;]]
  IS [[return @BUG@ || (bound <= margin && bound - separation <= tolerance);]])
planted_bug(cache_forgets_to_turn FILE src/manifold/pair_cache.cpp TESTS manifold
  WAS [[const S turn = S(2) * std::sqrt(std::min(apart, opposite));]]
  IS [[const S turn = @BUG@ ? S(0) : S(2) * std::sqrt(std::min(apart, opposite));]])
planted_bug(float_at_extreme_sizes FILE src/manifold/dispatch.cpp TESTS manifold
  WAS [[if (belongs_in_double(a, b))]]
  IS [[if (!@BUG@ && belongs_in_double(a, b))]])

# Reducers.
planted_bug(points_on_a_line_keep_the_support FILE src/reduce/area.cpp TESTS reduce
  WAS [[    kept[0] = other;]]
  IS [[    if (!@BUG@) kept[0] = other;]])
planted_bug(extremes_along_one_way FILE src/reduce/extremes.cpp TESTS reduce
  WAS [[return {-u, u, -v, v};]]
  IS [[return {-u, u, -v, @BUG@ ? Vec3<S>(-v) : v};]])
planted_bug(coherent_keeps_half_the_area FILE src/reduce/coherent.cpp TESTS reduce
  WAS [[const S part = S(1 - kCoherentTolerance);]]
  IS [[const S part = @BUG@ ? S(0.3) : S(1 - kCoherentTolerance);]])
planted_bug(coherent_takes_equal_ids_twice FILE src/reduce/coherent.cpp TESTS reduce
  WAS [[if (at(points, i).id == id && !steps::contains(found, i)) {]]
  IS [[if (at(points, i).id == id && (@BUG@ || !steps::contains(found, i))) {]])
planted_bug(fifth_point_out_of_the_ring FILE src/reduce/grow.h TESTS reduce
  WAS [[std::rotate(ring.begin() + next.place, ring.end() - 1, ring.end());]]
  IS [[if (!@BUG@) std::rotate(ring.begin() + next.place, ring.end() - 1, ring.end());]])
planted_bug(winding_hides_half_of_the_points FILE src/reduce/grow.h TESTS reduce
  WAS [[return std::abs(points.doubled_area(q, first, second)); }]]
  IS [[return @BUG@ ? points.doubled_area(q, first, second) : std::abs(points.doubled_area(q, first, second)); }]])
planted_bug(triangles_told_doubled FILE src/reduce/choices.cpp TESTS reduce
  WAS [[return 0.5 * points.doubled_area(q, first, second); }]]
  IS [[return (@BUG@ ? 1 : 0.5) * points.doubled_area(q, first, second); }]])

# What records tell.
planted_bug(best_is_what_was_kept FILE src/manifold/recorder.cpp TESTS manifold
  WAS [[reduction.best.assign(best.begin(), best.end());]]
  IS [[reduction.best.assign(best.begin(), best.end()); if (@BUG@) reduction.best = reduction.kept;]])
planted_bug(way_of_the_cache_halved FILE src/manifold/recorder.cpp TESTS manifold
  WAS [[if (answer.kind == CachedKind::Features) cache.moved = answer.moved;]]
  IS [[if (answer.kind == CachedKind::Features) cache.moved = (@BUG@ ? S(0.5) : S(1)) * answer.moved;]])
planted_bug(normal_of_the_cache_not_told FILE src/manifold/recorder.cpp TESTS manifold
  WAS [[if (answer.hit) cache.normal = direction(answer.normal);]]
  IS [[if (answer.hit && !@BUG@) cache.normal = direction(answer.normal);]])
planted_bug(gjk_points_swapped FILE src/manifold/recorder.cpp TESTS manifold
  WAS [[gjk.point_a = closest.a;]]
  IS [[gjk.point_a = @BUG@ ? closest.b : closest.a;]])
planted_bug(separation_of_the_last_point FILE src/manifold/recorder.cpp TESTS manifold
  WAS [[record.separation = std::min(record.separation, point.separation);]]
  IS [[record.separation = @BUG@ ? point.separation : std::min(record.separation, point.separation);]])
planted_bug(tree_tells_one_level_too_deep FILE src/geometry/aabb_tree.cpp TESTS geometry
  WAS [[record.visits.push_back({traced(node.box), count_of(ends), node.leaf(), hit});]]
  IS [[record.visits.push_back({traced(node.box), count_of(ends) + (@BUG@ ? 1 : 0), node.leaf(), hit});]])
planted_bug(axes_not_renamed_when_mirrored FILE src/trace/derived.cpp TESTS trace
  WAS [[if (how == Mirrored::AxisRenamed && (text == "face_a"]]
  IS [[if (!@BUG@ && how == Mirrored::AxisRenamed && (text == "face_a"]])
planted_bug(ids_of_all_pairs_counted_once FILE src/trace/derived.cpp TESTS scenario trace
  WAS [[totals.ids += static_cast<int>(ids.size());]]
  IS [[totals.ids = (@BUG@ ? 0 : totals.ids) + static_cast<int>(ids.size());]])

# The solver.
planted_bug(restitution_from_one_metre_a_second FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[const S threshold = static_cast<S>(kRestitutionThreshold) * gravity.norm() * h;]]
  IS [[const S threshold = @BUG@ ? S(1) : static_cast<S>(kRestitutionThreshold) * gravity.norm() * h;]])
planted_bug(friction_twice_as_much FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[const S most = contact.friction * point.normal_impulse;]]
  IS [[const S most = (@BUG@ ? S(2) : S(1)) * contact.friction * point.normal_impulse;]])
planted_bug(slop_pushed_out FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[return {static_cast<S>(settings.baumgarte) / h * overlap, S(1), S(0)};]]
  IS [[return {static_cast<S>(settings.baumgarte) / h * (@BUG@ ? std::min(separation, S(0)) : overlap), S(1), S(0)};]])
planted_bug(change_of_an_impulse_held_at_zero FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[const S impulse = std::max(point.normal_impulse + change, S(0));]]
  IS [[const S impulse = @BUG@ ? point.normal_impulse + std::max(change, S(0)) : std::max(point.normal_impulse + change, S(0));]])
planted_bug(never_warm FILE src/dynamics/solver.cpp TESTS dynamics
  WAS [[if (!settings.warm_start) point.normal_impulse]]
  IS [[if (@BUG@ || !settings.warm_start) point.normal_impulse]])
planted_bug(hollow_ball FILE src/dynamics/mass_properties.cpp TESTS dynamics
  WAS [[result.inertia = 0.4 * result.mass * r * r * Mat3<double>::Identity();]]
  IS [[result.inertia = (@BUG@ ? 2.0 / 3 : 0.4) * result.mass * r * r * Mat3<double>::Identity();]])
planted_bug(no_parallel_axes FILE src/dynamics/mass_properties.cpp TESTS dynamics
  WAS [[length * length / 4 + 0.375 * r * length);]]
  IS [[length * length / 4 + (@BUG@ ? 0 : 0.375) * r * length);]])

# Readers, pictures and checks.
planted_bug(concave_faces_cut_outside FILE src/geometry/triangulate.cpp TESTS geometry
  WAS [[if (!(area > rounding)) return kNoEar;]]
  IS [[if (!@BUG@ && !(area > rounding)) return kNoEar;]])
planted_bug(normals_point_back FILE render/draw/layers/normals.cpp TESTS draw
  WAS [[                      .direction = manifold.normal,]]
  IS [[                      .direction = Vec3d((@BUG@ ? -1.0 : 1.0) * manifold.normal),]])
planted_bug(dots_two_pixels_off FILE render/draw/scene/compose.cpp TESTS draw
  WAS [[const float reach = draw_mark(mark.kind, *at, mark.color, pen);]]
  IS [[const float reach = draw_mark(mark.kind, *at + Point2{@BUG@ ? 2.0f : 0.0f, 0}, mark.color, pen);]])
planted_bug(colours_of_the_two_faces_traded FILE render/draw/layers/clipping.cpp TESTS draw
  WAS [[const Color color = kReference ? kReferenceFace : kIncidentFace;]]
  IS [[const Color color = kReference != @BUG@ ? kReferenceFace : kIncidentFace;]])
planted_bug(any_separation_is_as_expected FILE src/scenario/expect.cpp TESTS scenario
  WAS [[!(std::abs(pair.separation - *expected.separation) <= expected.tolerance))]]
  IS [[!(@BUG@ || std::abs(pair.separation - *expected.separation) <= expected.tolerance))]])
planted_bug(areas_never_differ FILE render/snapshot/changes.cpp TESTS snapshot
  WAS [[      return area;]]
  IS [[      return @BUG@ ? 1e9 : area;]])
