// Mesa's driver is unloaded when its display is closed; what only its own variables pointed to would then look like a
// leak of ours, without a name to suppress it by. Linked into programs built with -fsanitize=address only.
extern "C" int dlclose(void*) {
  return 0;
}
