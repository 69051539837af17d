// OSMesa 22.3 keeps the buffers of its windows until the process ends and loses the pointer. The
// leak sanitizer asks this function what to overlook; without it nobody calls it.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa.so\n";
}
