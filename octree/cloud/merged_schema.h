// The attributes of several sources as those of one.
#pragma once

#include <memory>
#include <span>

#include "octree/cloud/attribute.h"
#include "octree/cloud/source.h"

namespace stipple {

// The sources' attributes under one name become one. Where they disagree about its type, scale or offset, all values
// are stored as double, scale and offset applied: exact for integers up to 53 bits. A source that lacks it gives zeros.
Schema merged_schema(std::span<const std::unique_ptr<PointSource>> sources);

// The column's values as doubles of the attribute that sources with different types share; components it lacks are
// zero.
Column converted(const Column& column, const Attribute& common);

// The values of points whose source lacks the attribute.
Column zeros(const Attribute& attribute, std::size_t points);

}  // namespace stipple
