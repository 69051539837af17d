#!/bin/sh
# The document's lines for GNU parallel.
. "$2/tests/recipes/common.sh"
command -v parallel > /dev/null || skip "GNU parallel is not installed (apt-get install parallel)"
parallel --version 2> /dev/null | grep -q GNU || skip "parallel is not GNU's"
export PARALLEL=--will-cite
repository
recipe 1 "parallel contactscope check --shard {}/4 --out shards ::: 1 2 3 4"
one_part_fails
recipe 0 "parallel contactscope render hull --shard {}/4 ::: 1 2 3 4"
all_rendered
