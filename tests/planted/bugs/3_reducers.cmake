# Reducers.
planted_bug(points_on_a_line_keep_the_support FILE src/reduce/area.cpp TESTS reduce
  WAS [[    kept[0] = other;]]
  IS [[    if (!@BUG@) kept[0] = other;]])
planted_bug(extremes_along_one_way FILE src/reduce/area.cpp TESTS reduce
  WAS [[return {-u, u, -v, v};]]
  IS [[return {-u, u, -v, @BUG@ ? Vec3<S>(-v) : v};]])
planted_bug(coherent_keeps_half_the_area FILE src/reduce/coherent.cpp TESTS reduce
  WAS [[const S part = S(1 - kCoherentTolerance);]]
  IS [[const S part = @BUG@ ? S(0.3) : S(1 - kCoherentTolerance);]])
planted_bug(coherent_takes_equal_ids_twice FILE src/reduce/steps.h TESTS reduce
  WAS [[if (id(i) == before && !steps::contains(found, i)) {]]
  IS [[if (id(i) == before && (@BUG@ || !steps::contains(found, i))) {]])
planted_bug(fifth_point_out_of_the_ring FILE src/reduce/grow.h TESTS reduce
  WAS [[std::rotate(ring.begin() + next.place, ring.end() - 1, ring.end());]]
  IS [[if (!@BUG@) std::rotate(ring.begin() + next.place, ring.end() - 1, ring.end());]])
planted_bug(winding_hides_half_of_the_points FILE src/reduce/grow.h TESTS reduce
  WAS [[return std::abs(points.doubled_area(q, first, second)); }]]
  IS [[return @BUG@ ? points.doubled_area(q, first, second) : std::abs(points.doubled_area(q, first, second)); }]])
planted_bug(triangles_told_doubled FILE src/reduce/choices.cpp TESTS reduce
  WAS [[return 0.5 * points.doubled_area(q, first, second); }]]
  IS [[return (@BUG@ ? 1 : 0.5) * points.doubled_area(q, first, second); }]])
planted_bug(ties_go_to_the_last_point FILE src/reduce/steps.h TESTS reduce
  WAS [[if (handicap * value > most + tie) {]]
  IS [[if (@BUG@ ? handicap * value >= most : handicap * value > most + tie) {]])
planted_bug(rounding_says_which_is_the_deepest FILE src/reduce/steps.h TESTS reduce
  WAS [[return S(8) * std::numeric_limits<S>::epsilon() * scale;]]
  IS [[return @BUG@ ? S(0) : S(8) * std::numeric_limits<S>::epsilon() * scale;]])
