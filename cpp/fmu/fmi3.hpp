// SPDX-License-Identifier: 0BSD
// FMI 3.0 for co-simulation over an instance. A variable of the points is an array, with one value reference.
#include "instance.hpp"
#include "types.hpp"

namespace asperity_fmu {

inline fmi3Status fmi3(Status status) { return static_cast<fmi3Status>(status); }

/// `act` on each value of each variable, of which there must be n_values.
template <class Act>
Status each_entry(Instance& instance, const fmi3ValueReference vr[], std::size_t nvr, std::size_t n_values, Act act) {
  Status status = Status::ok;
  std::size_t k = 0;
  for (std::size_t i = 0; i < nvr; ++i)
    for (std::size_t point = 0; point < (is_of_a_point(vr[i]) ? instance.model->points() : 1); ++point, ++k) {
      if (k >= n_values) return instance.error("there are more values than the " + std::to_string(n_values) + " given");
      status = worse(status, act(vr[i], point, k));
      if (status == Status::error) return status;
    }
  return k == n_values ? status
                       : instance.error("there are " + std::to_string(k) + " values, not " + std::to_string(n_values));
}

/// The member `act` on each, as a call of the host.
template <class Value, class Act>
Status each_value(fmi3Instance instance, const Call& call, const fmi3ValueReference vr[], std::size_t nvr,
                  Value values[], std::size_t n_values, Act act) {
  return guarded(instance, call, [&](Instance& of) {
    return each_entry(of, vr, nvr, n_values, [&](std::uint32_t variable, std::size_t point, std::size_t k) {
      return (of.*act)(variable, point, values[k]);
    });
  });
}

}  // namespace asperity_fmu

/// A function of the standard: its name, its parameters, and what gives its status.
#define ASPERITY_FMI3(name, parameters, ...) \
  ASPERITY_FMU_EXPORT fmi3Status name parameters { return fmi3(__VA_ARGS__); }

extern "C" {

ASPERITY_FMU_EXPORT const char* fmi3GetVersion(void) { return "3.0"; }
ASPERITY_FMI3(fmi3SetDebugLogging,
              (fmi3Instance instance, fmi3Boolean on, std::size_t n, const fmi3String categories[]),
              call(instance, &Instance::log, on, n, categories))

ASPERITY_FMU_EXPORT fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                                             fmi3Boolean, fmi3Boolean, fmi3Boolean event_mode,
                                                             fmi3Boolean, const fmi3ValueReference[],
                                                             std::size_t intermediate, fmi3InstanceEnvironment host,
                                                             fmi3LogMessageCallback log,
                                                             fmi3IntermediateUpdateCallback) {
  try {
    std::function<void(Status, const char*)> tell;
    if (log != nullptr)
      tell = [log, host](Status status, const char* message) {
        log(host, fmi3(status), status == Status::warning ? warnings : errors, message);
      };
    if (event_mode || intermediate > 0) {
      if (tell)
        tell(Status::error, "this FMU has neither an event mode nor intermediate updates: must not be asked for");
      return nullptr;
    }
    return make_instance(name, token, "instantiation token",
                         std::filesystem::u8path(resources == nullptr ? "" : resources), std::move(tell));
  } catch (...) {
    return nullptr;
  }
}
ASPERITY_FMU_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                                              fmi3Boolean, fmi3InstanceEnvironment,
                                                              fmi3LogMessageCallback) {
  return nullptr;  // this FMU is for co-simulation
}
ASPERITY_FMU_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                                                   fmi3Boolean, fmi3InstanceEnvironment,
                                                                   fmi3LogMessageCallback, fmi3ClockUpdateCallback,
                                                                   fmi3LockPreemptionCallback,
                                                                   fmi3UnlockPreemptionCallback) {
  return nullptr;  // this FMU is for co-simulation
}
ASPERITY_FMU_EXPORT void fmi3FreeInstance(fmi3Instance instance) { delete static_cast<Instance*>(instance); }

ASPERITY_FMI3(fmi3EnterInitializationMode,
              (fmi3Instance instance, fmi3Boolean, fmi3Float64, fmi3Float64 start, fmi3Boolean has_stop,
               fmi3Float64 stop),
              guarded(instance, entering, [&](Instance& of) {
                const Status status = of.begin(start, has_stop, stop);
                return status == Status::ok ? of.enter(entering, initializing) : status;
              }))
ASPERITY_FMI3(fmi3ExitInitializationMode, (fmi3Instance instance), call(instance, &Instance::enter, exiting, stepping))
ASPERITY_FMI3(fmi3Terminate, (fmi3Instance instance), call(instance, &Instance::enter, terminating, terminated))
ASPERITY_FMI3(fmi3Reset, (fmi3Instance instance), call(instance, &Instance::reset))

#define ASPERITY_FMU_GET(type, act)                                                                          \
  ASPERITY_FMI3(fmi3Get##type,                                                                               \
                (fmi3Instance instance, const fmi3ValueReference vr[], std::size_t nvr, fmi3##type values[], \
                 std::size_t n_values),                                                                      \
                each_value(instance, reading, vr, nvr, values, n_values, act))
#define ASPERITY_FMU_SET(type, act)                                                                                \
  ASPERITY_FMI3(fmi3Set##type,                                                                                     \
                (fmi3Instance instance, const fmi3ValueReference vr[], std::size_t nvr, const fmi3##type values[], \
                 std::size_t n_values),                                                                            \
                each_value(instance, setting, vr, nvr, values, n_values, act))
ASPERITY_FMU_GET(Float64, &Instance::get)
ASPERITY_FMU_SET(Float64, &Instance::set)
ASPERITY_FMU_GET(Int32, &Instance::get_integer)
ASPERITY_FMU_GET(Boolean, &Instance::get_switch<fmi3Boolean>)
ASPERITY_FMU_SET(Boolean, &Instance::set_switch)
#undef ASPERITY_FMU_GET
#undef ASPERITY_FMU_SET

// Types of which there is no variable.
#define ASPERITY_FMU_NO_VARIABLE(type)                                                                                 \
  ASPERITY_FMI3(fmi3Get##type,                                                                                         \
                (fmi3Instance instance, const fmi3ValueReference[], std::size_t nvr, fmi3##type[], std::size_t),       \
                no_variable_of(instance, nvr, #type))                                                                  \
  ASPERITY_FMI3(fmi3Set##type,                                                                                         \
                (fmi3Instance instance, const fmi3ValueReference[], std::size_t nvr, const fmi3##type[], std::size_t), \
                no_variable_of(instance, nvr, #type))
ASPERITY_FMU_NO_VARIABLE(Float32)
ASPERITY_FMU_NO_VARIABLE(Int8)
ASPERITY_FMU_NO_VARIABLE(UInt8)
ASPERITY_FMU_NO_VARIABLE(Int16)
ASPERITY_FMU_NO_VARIABLE(UInt16)
ASPERITY_FMU_NO_VARIABLE(UInt32)
ASPERITY_FMU_NO_VARIABLE(Int64)
ASPERITY_FMU_NO_VARIABLE(UInt64)
ASPERITY_FMU_NO_VARIABLE(String)
#undef ASPERITY_FMU_NO_VARIABLE
ASPERITY_FMI3(fmi3SetInt32,
              (fmi3Instance instance, const fmi3ValueReference[], std::size_t nvr, const fmi3Int32[], std::size_t),
              no_variable_of(instance, nvr, "Int32 that can be set"))
ASPERITY_FMI3(fmi3GetBinary,
              (fmi3Instance instance, const fmi3ValueReference[], std::size_t nvr, std::size_t[], fmi3Binary[],
               std::size_t),
              no_variable_of(instance, nvr, "Binary"))
ASPERITY_FMI3(fmi3SetBinary,
              (fmi3Instance instance, const fmi3ValueReference[], std::size_t nvr, const std::size_t[],
               const fmi3Binary[], std::size_t),
              no_variable_of(instance, nvr, "Binary"))
ASPERITY_FMI3(fmi3GetClock, (fmi3Instance instance, const fmi3ValueReference[], std::size_t nvr, fmi3Clock[]),
              no_variable_of(instance, nvr, "Clock"))
ASPERITY_FMI3(fmi3SetClock, (fmi3Instance instance, const fmi3ValueReference[], std::size_t nvr, const fmi3Clock[]),
              no_variable_of(instance, nvr, "Clock"))

ASPERITY_FMI3(fmi3GetFMUState, (fmi3Instance instance, fmi3FMUState* state), call(instance, &Instance::keep, state))
ASPERITY_FMI3(fmi3SetFMUState, (fmi3Instance instance, fmi3FMUState state), call(instance, &Instance::restore, state))
ASPERITY_FMI3(fmi3FreeFMUState, (fmi3Instance instance, fmi3FMUState* state), call(instance, &Instance::forget, state))
ASPERITY_FMI3(fmi3SerializedFMUStateSize, (fmi3Instance instance, fmi3FMUState state, std::size_t* size),
              call(instance, &Instance::size_of, state, size))
ASPERITY_FMI3(fmi3SerializeFMUState, (fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[], std::size_t size),
              call(instance, &Instance::write, state, bytes, size))
ASPERITY_FMI3(fmi3DeserializeFMUState,
              (fmi3Instance instance, const fmi3Byte bytes[], std::size_t size, fmi3FMUState* state),
              call(instance, &Instance::read, bytes, size, state))

ASPERITY_FMU_EXPORT fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                                            std::size_t n_unknowns, const fmi3ValueReference knowns[],
                                                            std::size_t n_knowns, const fmi3Float64 seed[],
                                                            std::size_t n_seed, fmi3Float64 sensitivity[],
                                                            std::size_t n_sensitivity) {
  return fmi3(guarded(instance, reading, [&](Instance& of) {
    const auto add = [&](std::uint32_t output, std::size_t point, std::size_t i) {
      sensitivity[i] = 0;
      return each_entry(of, knowns, n_knowns, n_seed, [&](std::uint32_t input, std::size_t at, std::size_t k) {
        if (at != point) return Status::ok;
        return of.add_slope(output, input, point, seed[k], sensitivity[i]);
      });
    };
    return each_entry(of, unknowns, n_unknowns, n_sensitivity, add);
  }));
}

ASPERITY_FMU_EXPORT fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 from, fmi3Float64 size, fmi3Boolean,
                                          fmi3Boolean* event, fmi3Boolean* terminate, fmi3Boolean* early,
                                          fmi3Float64* reached) {
  return fmi3(guarded(instance, stepping_on, [&](Instance& of) {
    const Status status = of.step(from, size);
    for (fmi3Boolean* const answer : {event, terminate, early})
      if (answer != nullptr) *answer = false;
    if (reached != nullptr) *reached = of.model->state().settings.time;
    return status;
  }));
}

// Functions of what this FMU says it has not.
#define ASPERITY_FMU_NOT_OFFERED(name, parameters) \
  ASPERITY_FMI3(name, parameters, call(instance, &Instance::error, #name " is not offered"))
ASPERITY_FMU_NOT_OFFERED(fmi3EnterEventMode, (fmi3Instance instance))
ASPERITY_FMU_NOT_OFFERED(fmi3EnterStepMode, (fmi3Instance instance))
ASPERITY_FMU_NOT_OFFERED(fmi3GetNumberOfVariableDependencies, (fmi3Instance instance, fmi3ValueReference, std::size_t*))
ASPERITY_FMU_NOT_OFFERED(fmi3GetVariableDependencies,
                         (fmi3Instance instance, fmi3ValueReference, std::size_t[], fmi3ValueReference[], std::size_t[],
                          fmi3DependencyKind[], std::size_t))
ASPERITY_FMU_NOT_OFFERED(fmi3GetAdjointDerivative,
                         (fmi3Instance instance, const fmi3ValueReference[], std::size_t, const fmi3ValueReference[],
                          std::size_t, const fmi3Float64[], std::size_t, fmi3Float64[], std::size_t))
ASPERITY_FMU_NOT_OFFERED(fmi3EnterConfigurationMode, (fmi3Instance instance))
ASPERITY_FMU_NOT_OFFERED(fmi3ExitConfigurationMode, (fmi3Instance instance))
ASPERITY_FMU_NOT_OFFERED(fmi3GetIntervalDecimal, (fmi3Instance instance, const fmi3ValueReference[], std::size_t,
                                                  fmi3Float64[], fmi3IntervalQualifier[]))
ASPERITY_FMU_NOT_OFFERED(fmi3GetIntervalFraction, (fmi3Instance instance, const fmi3ValueReference[], std::size_t,
                                                   fmi3UInt64[], fmi3UInt64[], fmi3IntervalQualifier[]))
ASPERITY_FMU_NOT_OFFERED(fmi3GetShiftDecimal,
                         (fmi3Instance instance, const fmi3ValueReference[], std::size_t, fmi3Float64[]))
ASPERITY_FMU_NOT_OFFERED(fmi3GetShiftFraction,
                         (fmi3Instance instance, const fmi3ValueReference[], std::size_t, fmi3UInt64[], fmi3UInt64[]))
ASPERITY_FMU_NOT_OFFERED(fmi3SetIntervalDecimal,
                         (fmi3Instance instance, const fmi3ValueReference[], std::size_t, const fmi3Float64[]))
ASPERITY_FMU_NOT_OFFERED(fmi3SetIntervalFraction, (fmi3Instance instance, const fmi3ValueReference[], std::size_t,
                                                   const fmi3UInt64[], const fmi3UInt64[]))
ASPERITY_FMU_NOT_OFFERED(fmi3SetShiftDecimal,
                         (fmi3Instance instance, const fmi3ValueReference[], std::size_t, const fmi3Float64[]))
ASPERITY_FMU_NOT_OFFERED(fmi3SetShiftFraction, (fmi3Instance instance, const fmi3ValueReference[], std::size_t,
                                                const fmi3UInt64[], const fmi3UInt64[]))
ASPERITY_FMU_NOT_OFFERED(fmi3EvaluateDiscreteStates, (fmi3Instance instance))
ASPERITY_FMU_NOT_OFFERED(fmi3UpdateDiscreteStates, (fmi3Instance instance, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                                                    fmi3Boolean*, fmi3Boolean*, fmi3Float64*))
ASPERITY_FMU_NOT_OFFERED(fmi3EnterContinuousTimeMode, (fmi3Instance instance))
ASPERITY_FMU_NOT_OFFERED(fmi3CompletedIntegratorStep, (fmi3Instance instance, fmi3Boolean, fmi3Boolean*, fmi3Boolean*))
ASPERITY_FMU_NOT_OFFERED(fmi3SetTime, (fmi3Instance instance, fmi3Float64))
ASPERITY_FMU_NOT_OFFERED(fmi3SetContinuousStates, (fmi3Instance instance, const fmi3Float64[], std::size_t))
ASPERITY_FMU_NOT_OFFERED(fmi3GetContinuousStateDerivatives, (fmi3Instance instance, fmi3Float64[], std::size_t))
ASPERITY_FMU_NOT_OFFERED(fmi3GetEventIndicators, (fmi3Instance instance, fmi3Float64[], std::size_t))
ASPERITY_FMU_NOT_OFFERED(fmi3GetContinuousStates, (fmi3Instance instance, fmi3Float64[], std::size_t))
ASPERITY_FMU_NOT_OFFERED(fmi3GetNominalsOfContinuousStates, (fmi3Instance instance, fmi3Float64[], std::size_t))
ASPERITY_FMU_NOT_OFFERED(fmi3GetNumberOfEventIndicators, (fmi3Instance instance, std::size_t*))
ASPERITY_FMU_NOT_OFFERED(fmi3GetNumberOfContinuousStates, (fmi3Instance instance, std::size_t*))
ASPERITY_FMU_NOT_OFFERED(fmi3GetOutputDerivatives, (fmi3Instance instance, const fmi3ValueReference[], std::size_t,
                                                    const fmi3Int32[], fmi3Float64[], std::size_t))
ASPERITY_FMU_NOT_OFFERED(fmi3ActivateModelPartition, (fmi3Instance instance, fmi3ValueReference, fmi3Float64))
#undef ASPERITY_FMU_NOT_OFFERED

}  // extern "C"
#undef ASPERITY_FMI3
