// Attributes of a whole cloud, without its positions.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/cloud/source.h"

namespace stipple {

// Room for the named attributes of all points; `indices` become their numbers in the schema. Names that the source
// lacks are left out.
std::vector<Column> columns_for(const SourceInfo& info, const std::vector<std::string>& attributes,
                                std::vector<std::size_t>& indices);

// Element i of the batch's columns becomes that of point batch.first + i in `columns`, which are the same attributes.
void put_columns(const PointBatch& batch, std::vector<Column>& columns);

// Reads the named attributes on all cores: element i of each column is that of point i. Names the source lacks are left
// out. Throws Error when the source does.
std::vector<Column> load_columns(const PointSource& source, const std::vector<std::string>& attributes);

}  // namespace stipple
