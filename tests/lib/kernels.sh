# Which of OpenBLAS's kinds of kernels (OPENBLAS_CORETYPE) this CPU can run: kernels prints them. Sourced.
# shellcheck shell=bash

cpu_flags() {
    local flag
    for flag; do grep -qw "$flag" /proc/cpuinfo || return; done
}

kernels() {
    local all=()
    cpu_flags pni && all+=(Prescott)
    cpu_flags sse4_2 && all+=(Nehalem)
    cpu_flags avx && all+=(Sandybridge)
    cpu_flags avx2 fma && all+=(Haswell Zen)
    cpu_flags avx512f avx512dq avx512bw avx512vl && all+=(SkylakeX)
    echo "${all[*]}"
}
