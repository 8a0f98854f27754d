#include "render/gpu/time_stamp.h"

namespace stipple {
namespace {

GLuint make_query() {
  GLuint name = 0;
  glCreateQueries(GL_TIMESTAMP, 1, &name);
  return name;
}

}  // namespace

TimeStamp::TimeStamp() : query_(make_query()) {}

void TimeStamp::write_to(const GpuBuffer& buffer, std::size_t offset) const {
  glGetQueryBufferObjectui64v(query_.name(), buffer.name(), GL_QUERY_RESULT, static_cast<GLintptr>(offset));
}

}  // namespace stipple
