// The index of this invocation among all of a dispatch whose groups may be folded into two dimensions. Include it after the
// work group's size.
uint invocation_index() {
  return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}
