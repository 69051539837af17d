#pragma once

/// Instantiates one to five function templates, each for float and for double. Each name must have
/// a single template and its first parameter must be the scalar.
#define CONTACTSCOPE_FLOAT_AND_DOUBLE(...) \
  CONTACTSCOPE_RESCAN(CONTACTSCOPE_RESCAN( \
      CONTACTSCOPE_RESCAN(CONTACTSCOPE_RESCAN(CONTACTSCOPE_FIRST_NAME(__VA_ARGS__)))))

// A macro does not expand itself, so that each further name needs one more scan.
#define CONTACTSCOPE_RESCAN(...) __VA_ARGS__
#define CONTACTSCOPE_NOTHING
#define CONTACTSCOPE_NEXT_NAME() CONTACTSCOPE_FIRST_NAME
#define CONTACTSCOPE_FIRST_NAME(function, ...)                     \
  template decltype(function<float>) function<float>;              \
  template decltype(function<double>) function<double> __VA_OPT__( \
      ; CONTACTSCOPE_NEXT_NAME CONTACTSCOPE_NOTHING()(__VA_ARGS__))
