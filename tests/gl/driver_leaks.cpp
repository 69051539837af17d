// OSMesa 22.3 keeps the buffers of its windows until the process ends and loses the pointer. The
// leak sanitizer calls this function for suppressions; without the sanitizer it is unused.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa.so\n"; }
