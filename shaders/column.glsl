// An invocation for some pixels one above the other (dispatch_columns).
layout(local_size_x = 64) in;

const int kRows = 16;

ivec2 first_of_column() { return ivec2(gl_GlobalInvocationID.x, gl_WorkGroupID.y * kRows); }
// Of them, in a picture of this size.
int rows_of_column(ivec2 size) {
  ivec2 first = first_of_column();
  return first.x < size.x ? min(kRows, size.y - first.y) : 0;
}
