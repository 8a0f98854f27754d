#include <cmath>
#include <cstdio>

#include "octree/core/error.h"
#include "octree/read/las/las_source.h"
#include "render/gpu/shader_source.h"
#include "render/measure/psnr.h"

int main() {
  try {
    stipple::LasSource("no-such-file.las");
    return 1;
  } catch (const stipple::Error&) {
  }
  if (!std::isinf(stipple::psnr_db(0))) return 1;
  if (stipple::embedded_shaders().empty()) return 1;
  std::puts("stipple::octree and stipple::render work from the installed package");
}
