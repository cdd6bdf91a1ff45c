#pragma once

#include "fuzz/byte_source.h"
#include "surface/triangle_surface.h"

namespace hexwall::test {

/// A small vessel, made worse as the bytes say: the first one chooses the vessel, each further one
/// a change, followed by what the change needs (see `changes` in the source file). All bytes mean
/// something, and a few changed bytes are a few changed changes. At most 1500 triangles.
TriangleSurface mutated_surface(ByteSource& bytes);

}  // namespace hexwall::test
