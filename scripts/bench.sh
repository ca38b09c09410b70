#!/usr/bin/env bash
# Runs the benchmarks and writes docs/benchmarks.md, its CSV files (docs/benchmarks/) and plots (docs/images/benchmarks/).
# Usage: scripts/bench.sh [STAGE...]     without stages: all of them, in less than an hour on two cores
#   Stages: accuracy convergence work-precision siconos peers cost instructions speed plots page
#   Only if named: latency (live playing, docs/player/player.md; a million blocks each, hours), blocks (the same page's table of
#   all presets, minutes)
# The reference solutions are files; benchmarks/reference/make_references.py remakes them.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

all=(accuracy convergence work-precision siconos peers cost instructions speed plots page)
named_only=(latency blocks)
stages=("$@")
((${#stages[@]})) || stages=("${all[@]}")
for stage in "${stages[@]}"; do
    [[ " ${all[*]} ${named_only[*]} " == *" $stage "* ]] ||
        { echo "bench.sh: unknown stage '$stage' (allowed: ${all[*]} ${named_only[*]})" >&2; exit 2; }
done

export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
python=/usr/bin/python3  # Debian's: Siconos and matplotlib are packages of it
bin=build/release/bin
data=docs/benchmarks
mkdir -p "$data"
trap 'rm -f "$data"/*.part' EXIT

# into NAME COMMAND...: its Markdown table becomes docs/benchmarks/NAME.csv, whole or not at all.
into() {
    local name=$1
    shift
    "$@" | benchmarks/page/csv_of_table.py > "$data/$name.csv.part"
    mv "$data/$name.csv.part" "$data/$name.csv"
}

# script NAME SCRIPT...: the same for scripts that write CSV themselves.
script() {
    local name=$1
    shift
    "$python" -B "$@" --out "$data/$name.csv.part"
    mv "$data/$name.csv.part" "$data/$name.csv"
}

# A rise is told on stderr and is no reason to stop here: that is for scripts/test.sh --full.
counted() { "$python" -B benchmarks/instructions/count.py || true; }

run_stage() {
    case "$1" in
        accuracy) into coefficients "$bin/coefficient_accuracy" ;;
        convergence) script convergence benchmarks/work_precision/convergence.py ;;
        work-precision) script work_precision benchmarks/work_precision/run.py ;;
        siconos) script siconos benchmarks/rivals/siconos_cost.py ;;
        peers) script peers benchmarks/peers/run.py ;;
        cost)
            into memory "$bin/memory_and_compile" benchmarks/work_precision/scenes/guitar.json
            into first_sound "$python" -B benchmarks/cost/first_sound.py
            ;;
        instructions) into instructions counted ;;
        speed) "$python" -B scripts/speed_page.py "$bin" ;;
        plots)
            for plot in work_precision convergence coefficients peers; do
                "$python" -B "benchmarks/plots/$plot.py"
            done
            ;;
        page) "$python" -B benchmarks/page/page.py ;;
        blocks) "$python" -B scripts/block_times.py "$bin/jawari" ;;
        latency) "$bin/jawari" bench-latency --csv "$data/latency.csv" --plot docs/images/benchmarks/latency.svg ;;
    esac
}

scripts/setup.sh --bench
mkdir -p build
cmake --preset release > build/bench-configure.log 2>&1 || { cat build/bench-configure.log >&2; exit 1; }
cmake --build --preset release --parallel "$(nproc)" --target jawari trajectory coefficient_accuracy memory_and_compile \
    kernel_loop speed_tables kernel_benchmarks exactness resolution_errors adversarial
for stage in "${stages[@]}"; do
    start=$SECONDS
    echo "== $stage"
    run_stage "$stage"
    echo "   $((SECONDS - start)) s"
done
echo "docs/benchmarks.md: $((SECONDS / 60)) min $((SECONDS % 60)) s"
