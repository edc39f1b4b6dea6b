// Marks what a shared library shows to its users; everything else stays hidden.
#pragma once

#if defined(_WIN32) && defined(ASPERITY_SHARED)
#ifdef ASPERITY_BUILDING
#define ASPERITY_EXPORT __declspec(dllexport)
#else
#define ASPERITY_EXPORT __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define ASPERITY_EXPORT __attribute__((visibility("default")))
#else
#define ASPERITY_EXPORT
#endif
