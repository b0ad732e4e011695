#!/usr/bin/env bash
# Makes meshes/beam.msh: a bar of [0, 1] x [-0.1, 0.1]^2 in 24 x 4 x 4 cells of six tets each, all cut alike (Kuhn 1960),
# so that what is told by colours has no pattern of its own. ./make_beam.sh > meshes/beam.msh
set -euo pipefail
awk -v nx="${1:-24}" -v n="${2:-4}" 'BEGIN {
  vertices = (nx + 1) * (n + 1) * (n + 1)
  print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" vertices
  for (i = 0; i <= nx; ++i) for (j = 0; j <= n; ++j) for (k = 0; k <= n; ++k)
    printf "%d %.6g %.6g %.6g\n", ++v, i / nx, 0.2 * j / n - 0.1, 0.2 * k / n - 0.1
  print "$EndNodes\n$Elements\n" 6 * nx * n * n
  step["x"] = (n + 1) * (n + 1); step["y"] = n + 1; step["z"] = 1
  split("xyz yzx zxy xzy zyx yxz", ways, " ")   # the last three are odd: turned
  for (i = 0; i < nx; ++i) for (j = 0; j < n; ++j) for (k = 0; k < n; ++k) for (w = 1; w <= 6; ++w) {
    a = 1 + i * step["x"] + j * step["y"] + k
    b = a + step[substr(ways[w], 1, 1)]; c = b + step[substr(ways[w], 2, 1)]; d = c + step[substr(ways[w], 3, 1)]
    if (w > 3) { t = b; b = c; c = t }
    print ++e, 4, 2, 1, 1, a, b, c, d
  }
  print "$EndElements"
}'
