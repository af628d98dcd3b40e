# SPDX-License-Identifier: BSD-3-Clause
# Reads `objdump -d` of a law's library: each clone of each step loop must take its square roots by whole vectors.
function finish() {
  if (loop != "" && !packed) {
    print "not vectorised: " loop
    failed = 1
  }
}
/^[0-9a-f]+ <.*>:$/ {
  finish()
  loop = ""; packed = 0
  if (match($0, /evaluate_(chunk|varied).*\.(arch_x86_64_v4|arch_x86_64_v3|default)/)) {
    loop = $2
    width = /arch_x86_64_v4/ ? "%zmm" : /arch_x86_64_v3/ ? "%ymm" : "%xmm"
    found[(/evaluate_varied/ ? "varied " : "one ") width]++
  }
}
loop != "" && /sqrtpd/ && index($0, width) { packed = 1 }
END {
  finish()
  for (k in found) kinds++
  if (kinds != 6) {
    print "expected loops for one law and for varied ones, each for three instruction sets; found " kinds + 0 " of these 6"
    failed = 1
  }
  exit failed
}
