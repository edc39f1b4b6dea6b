/* A host in C, built against the standards' own headers (https://fmi-standard.org): it loads the library of an FMU, sets
   pressure and velocity from its standard input, and prints the bits that it gets. Guards against: another calling
   convention, other types, a missing function, a C++ symbol that the host would have to have.
     host LIBRARY RESOURCES 2 TOKEN < points.txt
   RESOURCES is a URI for FMI 2.0, a folder for 3.0; TOKEN the guid, in 3.0 the instantiationToken, that is in the
   FMU's modelDescription.xml. */
#include <stdio.h>
#include <stdarg.h>
#include <string.h>

#include "fmi2FunctionTypes.h"
#include "fmi3PlatformTypes.h"
#include "fmi3FunctionTypes.h"

#ifdef _WIN32
#include <windows.h>
static void* open_library(const char* path) { return (void*)LoadLibraryA(path); }
static void* function(void* library, const char* name) { return (void*)GetProcAddress((HMODULE)library, name); }
#else
#include <dlfcn.h>
static void* open_library(const char* path) {
  void* library = dlopen(path, RTLD_NOW);
  if (library == NULL) fprintf(stderr, "%s\n", dlerror());
  return library;
}
static void* function(void* library, const char* name) { return dlsym(library, name); }
#endif

#define TAKE(type, name)                                      \
  type* name = (type*)function(library, #name);               \
  if (name == NULL) {                                         \
    fprintf(stderr, "the library has no " #name "\n");        \
    return 1;                                                 \
  }

static void log_of_2(fmi2ComponentEnvironment host, fmi2String name, fmi2Status status, fmi2String category,
                 fmi2String message, ...) {
  va_list list;
  (void)host;
  fprintf(stderr, "%s %d %s: ", name, (int)status, category);
  va_start(list, message);
  vfprintf(stderr, message, list);
  va_end(list);
  fprintf(stderr, "\n");
}

static void log_of_3(fmi3InstanceEnvironment host, fmi3Status status, fmi3String category, fmi3String message) {
  (void)host;
  fprintf(stderr, "%d %s: %s\n", (int)status, category, message);
}

enum { outputs = 7 };
static const unsigned int input_references[] = {1, 2}, references[] = {8, 9, 10, 11, 12, 13, 14}, is_inside[] = {15};

/* Numbers as bits, in halves: C libraries differ in the seventeenth digit, read or written. */
static int read_pair(double* in) {
  unsigned long high = 0, low = 0;
  for (int i = 0; i < 2; ++i) {
    if (scanf("%lx %lx", &high, &low) != 2) return 0;
    const unsigned long long bits = ((unsigned long long)high << 32) | low;
    memcpy(&in[i], &bits, sizeof bits);
  }
  return 1;
}

static void print_all(const double* out, int inside) {
  for (int i = 0; i < outputs; ++i) {
    unsigned long long bits = 0;
    memcpy(&bits, &out[i], sizeof bits);
    printf("%08lx%08lx ", (unsigned long)(bits >> 32), (unsigned long)(bits & 0xffffffff));
  }
  printf("%d\n", inside);
}

static int host2(void* library, const char* resources, const char* token) {
  TAKE(fmi2InstantiateTYPE, fmi2Instantiate)
  TAKE(fmi2EnterInitializationModeTYPE, fmi2EnterInitializationMode)
  TAKE(fmi2ExitInitializationModeTYPE, fmi2ExitInitializationMode)
  TAKE(fmi2SetRealTYPE, fmi2SetReal)
  TAKE(fmi2GetRealTYPE, fmi2GetReal)
  TAKE(fmi2GetIntegerTYPE, fmi2GetInteger)
  TAKE(fmi2DoStepTYPE, fmi2DoStep)
  TAKE(fmi2FreeInstanceTYPE, fmi2FreeInstance)
  const fmi2CallbackFunctions callbacks = {log_of_2, NULL, NULL, NULL, NULL};
  fmi2Component c = fmi2Instantiate("host", fmi2CoSimulation, token, resources, &callbacks, 0, 0);
  double in[2], out[outputs];
  int inside = 0, step = 0;
  if (c == NULL || fmi2EnterInitializationMode(c) != fmi2OK || fmi2ExitInitializationMode(c) != fmi2OK) return 1;
  while (read_pair(in)) {
    if (fmi2SetReal(c, input_references, 2, in) > fmi2Warning || fmi2DoStep(c, step, 1, 1) > fmi2Warning) return 1;
    if (fmi2GetReal(c, references, outputs, out) > fmi2Warning) return 1;
    if (fmi2GetInteger(c, is_inside, 1, &inside) > fmi2Warning) return 1;
    print_all(out, inside);
    ++step;
  }
  fmi2FreeInstance(c);
  return 0;
}

static int host3(void* library, const char* resources, const char* token) {
  TAKE(fmi3InstantiateCoSimulationTYPE, fmi3InstantiateCoSimulation)
  TAKE(fmi3EnterInitializationModeTYPE, fmi3EnterInitializationMode)
  TAKE(fmi3ExitInitializationModeTYPE, fmi3ExitInitializationMode)
  TAKE(fmi3SetFloat64TYPE, fmi3SetFloat64)
  TAKE(fmi3GetFloat64TYPE, fmi3GetFloat64)
  TAKE(fmi3GetInt32TYPE, fmi3GetInt32)
  TAKE(fmi3DoStepTYPE, fmi3DoStep)
  TAKE(fmi3FreeInstanceTYPE, fmi3FreeInstance)
  fmi3Instance c =
      fmi3InstantiateCoSimulation("host", token, resources, false, false, false, false, NULL, 0, NULL, log_of_3, NULL);
  double in[2], out[outputs], reached = 0;
  fmi3Int32 inside = 0;
  bool event = true, end = true, early = true;
  int step = 0;
  if (c == NULL || fmi3EnterInitializationMode(c, false, 0, 0, false, 0) != fmi3OK) return 1;
  if (fmi3ExitInitializationMode(c) != fmi3OK) return 1;
  while (read_pair(in)) {
    if (fmi3SetFloat64(c, input_references, 2, in, 2) > fmi3Warning) return 1;
    if (fmi3DoStep(c, step, 1, true, &event, &end, &early, &reached) > fmi3Warning || event || end || early) return 1;
    if (fmi3GetFloat64(c, references, outputs, out, outputs) > fmi3Warning) return 1;
    if (fmi3GetInt32(c, is_inside, 1, &inside, 1) > fmi3Warning) return 1;
    print_all(out, inside);
    ++step;
  }
  fmi3FreeInstance(c);
  return 0;
}

int main(int count, char** arguments) {
  if (count != 5) return 2;
  void* library = open_library(arguments[1]);
  if (library == NULL) return 1;
  return (strcmp(arguments[3], "2") == 0 ? host2 : host3)(library, arguments[2], arguments[4]);
}
