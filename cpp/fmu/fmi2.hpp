// SPDX-License-Identifier: 0BSD
// FMI 2.0 for co-simulation over an instance. Value references of point i (from 0) are those of Variable + 32 i.
#include "instance.hpp"
#include "types.hpp"

namespace asperity_fmu {

inline fmi2Status fmi2(Status status) { return static_cast<fmi2Status>(status); }

/// `act` on each variable and its point. Parameters belong to point 0.
template <class Act>
Status each_value(fmi2Component c, const Call& call, const fmi2ValueReference vr[], std::size_t nvr, Act act) {
  return guarded(c, call, [&](Instance& instance) {
    Status status = Status::ok;
    for (std::size_t i = 0; i < nvr; ++i) {
      const std::uint32_t variable = vr[i] % stride, point = vr[i] / stride;
      if (point >= instance.model->points() || (point > 0 && !is_of_a_point(variable)) || variable == time)
        return instance.error("value reference " + std::to_string(vr[i]) + " is unknown");
      status = worse(status, act(instance, variable, point, i));
      if (status == Status::error) return status;
    }
    return status;
  });
}

/// The member `act` on each variable, its point and its value.
template <class Value, class Act>
Status each_value(fmi2Component c, const Call& call, const fmi2ValueReference vr[], std::size_t nvr, Value value[],
                  Act act) {
  return each_value(c, call, vr, nvr,
                    [&](Instance& instance, std::uint32_t variable, std::size_t point, std::size_t i) {
                      return (instance.*act)(variable, point, value[i]);
                    });
}

}  // namespace asperity_fmu

using namespace asperity_fmu;

/// A function of the standard: its name, its parameters, and what gives its status.
#define ASPERITY_FMI2(name, parameters, ...) \
  ASPERITY_FMU_EXPORT fmi2Status name parameters { return fmi2(__VA_ARGS__); }

extern "C" {

ASPERITY_FMU_EXPORT const char* fmi2GetTypesPlatform(void) { return "default"; }
ASPERITY_FMU_EXPORT const char* fmi2GetVersion(void) { return "2.0"; }
ASPERITY_FMI2(fmi2SetDebugLogging, (fmi2Component c, fmi2Boolean on, std::size_t n, const fmi2String categories[]),
              call(c, &Instance::log, on != 0, n, categories))

ASPERITY_FMU_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                                  const fmi2CallbackFunctions* functions, fmi2Boolean, fmi2Boolean) {
  try {
    std::function<void(Status, const char*)> tell;
    if (functions != nullptr && functions->logger != nullptr)
      tell = [log = functions->logger, host = functions->componentEnvironment,
              who = std::string(name == nullptr ? "" : name)](Status status, const char* message) {
        log(host, who.c_str(), fmi2(status), status == Status::warning ? warnings : errors, "%s", message);
      };
    if (type != fmi2CoSimulation) {
      if (tell) tell(Status::error, "this FMU is for co-simulation alone");
      return nullptr;
    }
    return make_instance(name, guid, "GUID", path_of_uri(resources == nullptr ? "" : resources), std::move(tell));
  } catch (...) {
    return nullptr;
  }
}

ASPERITY_FMU_EXPORT void fmi2FreeInstance(fmi2Component c) { delete static_cast<Instance*>(c); }

ASPERITY_FMI2(fmi2SetupExperiment,
              (fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start, fmi2Boolean has_stop, fmi2Real stop),
              guarded(c, setting_up, [&](Instance& instance) { return instance.begin(start, has_stop != 0, stop); }))
ASPERITY_FMI2(fmi2EnterInitializationMode, (fmi2Component c), call(c, &Instance::enter, entering, initializing))
ASPERITY_FMI2(fmi2ExitInitializationMode, (fmi2Component c), call(c, &Instance::enter, exiting, stepping))
ASPERITY_FMI2(fmi2Terminate, (fmi2Component c), call(c, &Instance::enter, terminating, terminated))
ASPERITY_FMI2(fmi2Reset, (fmi2Component c), call(c, &Instance::reset))

ASPERITY_FMI2(fmi2GetReal, (fmi2Component c, const fmi2ValueReference vr[], std::size_t nvr, fmi2Real value[]),
              each_value(c, reading, vr, nvr, value, &Instance::get))
ASPERITY_FMI2(fmi2SetReal, (fmi2Component c, const fmi2ValueReference vr[], std::size_t nvr, const fmi2Real value[]),
              each_value(c, setting, vr, nvr, value, &Instance::set))
ASPERITY_FMI2(fmi2GetInteger, (fmi2Component c, const fmi2ValueReference vr[], std::size_t nvr, fmi2Integer value[]),
              each_value(c, reading, vr, nvr, value, &Instance::get_integer))
ASPERITY_FMI2(fmi2SetInteger, (fmi2Component c, const fmi2ValueReference[], std::size_t nvr, const fmi2Integer[]),
              no_variable_of(c, nvr, "Integer that can be set"))
ASPERITY_FMI2(fmi2GetBoolean, (fmi2Component c, const fmi2ValueReference vr[], std::size_t nvr, fmi2Boolean value[]),
              each_value(c, reading, vr, nvr, value, &Instance::get_switch<fmi2Boolean>))
ASPERITY_FMI2(fmi2SetBoolean,
              (fmi2Component c, const fmi2ValueReference vr[], std::size_t nvr, const fmi2Boolean value[]),
              each_value(c, setting, vr, nvr, value, &Instance::set_switch))
ASPERITY_FMI2(fmi2GetString, (fmi2Component c, const fmi2ValueReference[], std::size_t nvr, fmi2String[]),
              no_variable_of(c, nvr, "String"))
ASPERITY_FMI2(fmi2SetString, (fmi2Component c, const fmi2ValueReference[], std::size_t nvr, const fmi2String[]),
              no_variable_of(c, nvr, "String"))

ASPERITY_FMI2(fmi2GetFMUstate, (fmi2Component c, fmi2FMUstate* state), call(c, &Instance::keep, state))
ASPERITY_FMI2(fmi2SetFMUstate, (fmi2Component c, fmi2FMUstate state), call(c, &Instance::restore, state))
ASPERITY_FMI2(fmi2FreeFMUstate, (fmi2Component c, fmi2FMUstate* state), call(c, &Instance::forget, state))
ASPERITY_FMI2(fmi2SerializedFMUstateSize, (fmi2Component c, fmi2FMUstate state, std::size_t* size),
              call(c, &Instance::size_of, state, size))
ASPERITY_FMI2(fmi2SerializeFMUstate, (fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], std::size_t size),
              call(c, &Instance::write, state, bytes, size))
ASPERITY_FMI2(fmi2DeSerializeFMUstate, (fmi2Component c, const fmi2Byte bytes[], std::size_t size, fmi2FMUstate* state),
              call(c, &Instance::read, bytes, size, state))

ASPERITY_FMU_EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[],
                                                            std::size_t n_unknowns, const fmi2ValueReference knowns[],
                                                            std::size_t n_knowns, const fmi2Real seed[],
                                                            fmi2Real sensitivity[]) {
  return fmi2(each_value(c, reading, unknowns, n_unknowns,
                         [&](Instance& instance, std::uint32_t output, std::size_t point, std::size_t i) {
                           sensitivity[i] = 0;
                           for (std::size_t k = 0; k < n_knowns; ++k) {
                             const std::uint32_t input = knowns[k] % stride;
                             if (knowns[k] / stride != point) continue;
                             if (instance.add_slope(output, input, point, seed[k], sensitivity[i]) == Status::error)
                               return Status::error;
                           }
                           return Status::ok;
                         }));
}

ASPERITY_FMI2(fmi2SetRealInputDerivatives,
              (fmi2Component c, const fmi2ValueReference[], std::size_t nvr, const fmi2Integer[], const fmi2Real[]),
              no_variable_of(c, nvr, "derivative of an input"))
ASPERITY_FMI2(fmi2GetRealOutputDerivatives,
              (fmi2Component c, const fmi2ValueReference[], std::size_t nvr, const fmi2Integer[], fmi2Real[]),
              no_variable_of(c, nvr, "derivative of an output"))
ASPERITY_FMI2(fmi2DoStep, (fmi2Component c, fmi2Real from, fmi2Real size, fmi2Boolean),
              guarded(c, stepping_on, [&](Instance& instance) { return instance.step(from, size); }))
// A step is never pending.
ASPERITY_FMU_EXPORT fmi2Status fmi2CancelStep(fmi2Component) { return fmi2Error; }
ASPERITY_FMU_EXPORT fmi2Status fmi2GetStatus(fmi2Component, const fmi2StatusKind, fmi2Status*) { return fmi2Discard; }
ASPERITY_FMU_EXPORT fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real* value) {
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  return fmi2(guarded(c, [&](Instance& instance) {
    *value = instance.model->state().settings.time;
    return Status::ok;
  }));
}
ASPERITY_FMU_EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component, const fmi2StatusKind, fmi2Integer*) {
  return fmi2Discard;
}
ASPERITY_FMU_EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component, const fmi2StatusKind, fmi2Boolean*) {
  return fmi2Discard;
}
ASPERITY_FMU_EXPORT fmi2Status fmi2GetStringStatus(fmi2Component, const fmi2StatusKind, fmi2String*) {
  return fmi2Discard;
}

}  // extern "C"
#undef ASPERITY_FMI2
