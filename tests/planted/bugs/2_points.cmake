# The pipeline: points.
planted_bug(most_parallel_incident_face FILE src/manifold/create_contact.cpp TESTS manifold
  WAS [[const S along = reference_normal.dot(hull.normal(face));]]
  IS [[const S along = (@BUG@ ? S(-1) : S(1)) * reference_normal.dot(hull.normal(face));]])
planted_bug(normal_of_b_not_turned FILE src/manifold/create_contact.cpp TESTS manifold
  WAS [[contact.normal = reference == Owner::A ? plane.normal : Vec3<S>(-plane.normal);]]
  IS [[contact.normal = reference == Owner::A || @BUG@ ? plane.normal : Vec3<S>(-plane.normal);]])
planted_bug(points_halfway_to_the_reference_face FILE src/manifold/create_contact.cpp TESTS manifold
  WAS [[const Vec3<S> moved = vertex.position - distance * plane.normal;]]
  IS [[const Vec3<S> moved = vertex.position - (@BUG@ ? S(0.5) : S(1)) * distance * plane.normal;]])
planted_bug(margin_forgotten_when_clipping FILE src/manifold/create_contact.cpp TESTS manifold
  WAS [[const S highest = highest_kept(margin, scale);]]
  IS [[const S highest = highest_kept(@BUG@ ? S(0) : margin, scale);]])
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
planted_bug(fallback_normal_does_not_turn FILE src/manifold/collide_sphere.cpp TESTS manifold
  WAS [[: b_in_a.rotate(Vec3<S>::UnitY());]]
  IS [[: @BUG@ ? Vec3<S>(Vec3<S>::UnitY()) : b_in_a.rotate(Vec3<S>::UnitY());]])
planted_bug(crossing_capsules_pulled_together FILE src/manifold/collide_capsule_capsule.cpp TESTS manifold
  WAS [[return normal.dot(between) < S(0) ? Vec3<S>(-normal) : normal;]]
  IS [[return !@BUG@ && normal.dot(between) < S(0) ? Vec3<S>(-normal) : normal;]])
planted_bug(antiparallel_capsules_pair_the_same_ends FILE src/manifold/collide_capsule_capsule.cpp TESTS manifold
  WAS [[const bool same_direction = axes.a.along.dot(axes.b.along) > S(0);]]
  IS [[const bool same_direction = @BUG@ || axes.a.along.dot(axes.b.along) > S(0);]])
planted_bug(one_point_for_two FILE src/manifold/collide_capsule_capsule.cpp TESTS manifold
  WAS [[for (int side = 0; side < 2; ++side) {]]
  IS [[for (int side = 0; side < (@BUG@ ? 1 : 2); ++side) {]])
planted_bug(ball_point_beside_the_hull FILE src/manifold/collide_sphere.cpp TESTS manifold
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
planted_bug(cache_never_gives_up FILE src/manifold/contact_depth.h TESTS manifold
  WAS [[return bound <= margin && bound - separation <= tolerance;]]
  IS [[return @BUG@ || (bound <= margin && bound - separation <= tolerance);]])
planted_bug(cache_forgets_to_turn FILE src/manifold/contact_depth.h TESTS manifold
  WAS [[return S(2) * std::sqrt(std::min(gap, opposite));]]
  IS [[return @BUG@ ? S(0) : S(2) * std::sqrt(std::min(gap, opposite));]])
planted_bug(float_at_extreme_sizes FILE src/manifold/dispatch.cpp TESTS manifold
  WAS [[if (belongs_in_double(a, b))]]
  IS [[if (!@BUG@ && belongs_in_double(a, b))]])
planted_bug(ids_of_traded_shapes_not_flipped FILE src/manifold/dispatch.h TESTS manifold
  WAS [[for (ContactPoint<S>& point : manifold.points) point.id = point.id.flipped();]]
  IS [[for (ContactPoint<S>& point : manifold.points) point.id = @BUG@ ? point.id : point.id.flipped();]])
planted_bug(ids_kept_before_not_flipped FILE src/manifold/dispatch.h TESTS manifold
  WAS [[if (swapped && !options.reduction.previous.empty())]]
  IS [[if (!@BUG@ && swapped && !options.reduction.previous.empty())]])
planted_bug(support_kept_however_far FILE src/manifold/pair_cache.cpp TESTS manifold
  WAS [[const bool still_deepest = S(2) * moved < cache.support_clearance;]]
  IS [[const bool still_deepest = @BUG@ || S(2) * moved < cache.support_clearance;]])

# Two boxes, which have a special path.
planted_bug(box_normal_of_b_not_turned FILE src/manifold/fast/box_face_contact.h TESTS manifold
  WAS [[contact.normal = of_a ? normal : -normal;]]
  IS [[contact.normal = of_a || @BUG@ ? normal : -normal;]])
planted_bug(box_ids_of_the_other_owner FILE src/manifold/fast/box_face_contact.h TESTS manifold
  WAS [[const int incident = faces.incident + (of_a ? 6 : 0)]]
  IS [[const int incident = faces.incident + (of_a != @BUG@ ? 6 : 0)]])

# Two capsules and a box on a mesh, which have special paths too.
planted_bug(capsule_normal_of_traded_shapes_not_turned FILE src/manifold/fast/collide_two_capsules.cpp TESTS manifold
  WAS [[direction * (swapped ? S(-1) : S(1))]]
  IS [[direction * (swapped && !@BUG@ ? S(-1) : S(1))]])
planted_bug(capsule_foot_from_the_first_end FILE src/manifold/fast/collide_two_capsules.cpp TESTS manifold
  WAS [[on[owner] = axes[owner].ends[end];]]
  IS [[on[owner] = axes[owner].ends[@BUG@ ? 0 : end];]])
planted_bug(triangle_on_a_box_from_behind FILE src/manifold/fast/box_on_triangles.cpp TESTS manifold
  WAS [[const int incident = sign * triangle.normal[axis] > S(0) ? 1 : 0;]]
  IS [[const int incident = (sign * triangle.normal[axis] > S(0)) != @BUG@ ? 1 : 0;]])
planted_bug(edge_of_a_triangle_climbs FILE src/query/fast/box_triangle_sat.h TESTS manifold query
  WAS [[const bool falls = along_face(second, vector<S>(triangle.directions[k])) < S(0);]]
  IS [[const bool falls = (along_face(second, vector<S>(triangle.directions[k])) < S(0)) != @BUG@;]])
