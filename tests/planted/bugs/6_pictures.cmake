# Readers, pictures and checks.
planted_bug(concave_faces_cut_outside FILE src/geometry/triangulate.cpp TESTS geometry
  WAS [[if (!(area > rounding)) return kNoEar;]]
  IS [[if (!@BUG@ && !(area > rounding)) return kNoEar;]])
planted_bug(normals_point_back FILE render/draw/layers/normals.cpp TESTS draw
  WAS [[                .direction = manifold.normal,]]
  IS [[                .direction = Vec3d((@BUG@ ? -1.0 : 1.0) * manifold.normal),]])
planted_bug(dots_two_pixels_off FILE render/draw/scene/compose.cpp TESTS draw
  WAS [[const float reach = draw_mark(mark.kind, *at, mark.color, pen, mark.size);]]
  IS [[const float reach = draw_mark(mark.kind, *at + Point2{@BUG@ ? 2.0f : 0.0f, 0}, mark.color, pen, mark.size);]])
planted_bug(colours_of_the_two_faces_traded FILE render/draw/layers/clipping.cpp TESTS draw
  WAS [[const Color color = kReference ? kReferenceFace : kIncidentFace;]]
  IS [[const Color color = kReference != @BUG@ ? kReferenceFace : kIncidentFace;]])
planted_bug(any_separation_is_as_expected FILE src/scenario/expect.cpp TESTS scenario
  WAS [[!(std::abs(pair.separation - *expected.separation) <= expected.tolerance))]]
  IS [[!(@BUG@ || std::abs(pair.separation - *expected.separation) <= expected.tolerance))]])
planted_bug(areas_never_differ FILE render/snapshot/changes.cpp TESTS snapshot
  WAS [[if (kind == Kind::Area) return area;]]
  IS [[if (kind == Kind::Area) return @BUG@ ? 1e9 : area;]])
planted_bug(impulses_kept_and_given_traded FILE render/draw/layers/impulses.cpp TESTS draw
  WAS [[scene.scales.impulse * (warm ? point.impulse->warm_start : point.impulse->normal);]]
  IS [[scene.scales.impulse * (warm != @BUG@ ? point.impulse->warm_start : point.impulse->normal);]])
planted_bug(friction_of_the_other_body FILE render/draw/layers/impulses.cpp TESTS draw
  WAS [[const Vec3d offset = side * share * scales.friction * point.impulse->friction;]]
  IS [[const Vec3d offset = (@BUG@ ? -side : side) * share * scales.friction * point.impulse->friction;]])
planted_bug(any_surplus_of_points_is_as_expected FILE src/scenario/expect.cpp TESTS scenario
  WAS [[if (!wanted || got == *wanted) return;]]
  IS [[if (!wanted || (@BUG@ ? got >= *wanted : got == *wanted)) return;]])
