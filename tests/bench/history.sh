#!/bin/sh
# Adds a row for each ratio below to history.tsv: one benchmark's minimum time over another's of the
# same run, so that it depends on the code and little on the machine.
#   history.sh BUILD_FOLDER HISTORY COMMIT [NOTE]
set -eu
build=$1 history=$2 commit=$3 note=${4:-}

rows=$(mktemp)
trap 'rm -f "$rows"' EXIT

# pairs: time of `contactscope` over Bullet, or over itself without a record, per workload.
[ ! -x "$build/pipeline_bench" ] || "$build/pipeline_bench" 2>/dev/null | awk '
  /^least/ { inside = 1; next }
  /^median/ { inside = 0 }
  inside && NF {
    name = substr($0, 1, 18); sub(/ +$/, "", name)
    if ($(NF - 2) != "-") print "recorded/unrecorded, " name "\t" $(NF - 2)
    if ($(NF - 1) != "-") print "unrecorded/Bullet, " name "\t" $(NF - 1)
  }' >> "$rows"

# reducers of 32 points; each cell is "least / median".
"$build/reduce_bench" --benchmark_filter='^(area|optimal|extremes|bullet)/32$' 2>/dev/null | awk '
  $(NF - 1) == "/" { least[$1] = $(NF - 2) }
  END {
    for (name in least)
      if (name != "area" && least["area"] > 0)
        printf "reduction by %s over area, 32 points\t%.3f\n", name, least[name] / least["area"]
  }' | sort >> "$rows"

#   ratio PROGRAM ONE OTHER
ratio() {
  "$build/$1" --benchmark_filter="^($2|$3)\$" --benchmark_repetitions=30 --benchmark_min_time=0.02 \
    --benchmark_enable_random_interleaving=true --benchmark_format=csv 2>/dev/null |
    awk -F, -v one="$2" -v other="$3" '
      { name = $1; gsub(/"/, "", name) }
      name == one || name == other {
        if (!(name in least) || $4 + 0 < least[name]) least[name] = $4 + 0
      }
      END { if (least[other] > 0) printf "%s over %s\t%.3f\n", one, other, least[one] / least[other] }
    ' >> "$rows"
}
ratio recorder_bench record/double record/float
ratio render_bench illustrate/ten_thousand_triangles illustrate/two_boxes
ratio render_bench svg/ten_thousand_triangles svg/two_boxes

[ -s "$rows" ] || { echo "history: no benchmark said anything" >&2; exit 2; }
awk -F'\t' -v commit="$commit" -v note="$note" -v OFS='\t' '{ print $1, commit, $2, note }' \
  "$rows" >> "$history"
echo "history: $(wc -l < "$rows") rows of $commit in $history"
