# Contents of records.
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
planted_bug(way_of_the_cache_not_told FILE src/manifold/recorder.cpp TESTS manifold
  WAS [[if (answer.kind == CachedKind::Features) cache.moved]]
  IS [[if (answer.kind == CachedKind::Features && !@BUG@) cache.moved]])
planted_bug(choices_tell_any_edge FILE src/reduce/choices.cpp TESTS reduce
  WAS [[choice.measures.push_back(*std::ranges::min_element(all, {}, &trace::Measure::value));]]
  IS [[choice.measures.push_back(@BUG@ ? all.front() : *std::ranges::min_element(all, {}, &trace::Measure::value));]])
planted_bug(ids_not_flipped_when_mirrored FILE src/trace/derived.cpp TESTS trace
  WAS [[if (how == Mirrored::IdFlipped) text = flipped_id(text);]]
  IS [[if (!@BUG@ && how == Mirrored::IdFlipped) text = flipped_id(text);]])
planted_bug(overlap_of_the_last_point FILE src/trace/derived.cpp TESTS trace scenario
  WAS [[totals.penetration = std::max(totals.penetration, -point.separation);]]
  IS [[totals.penetration = @BUG@ ? -point.separation : std::max(totals.penetration, -point.separation);]])
