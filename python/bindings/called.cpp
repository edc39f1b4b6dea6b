// What pybind11 finds behind an object of cls.__new__(cls), which a forged pickle can ask for, is memory that nobody
// filled. So classes are made by calling them, and by nothing else.
#include <pybind11/pybind11.h>

#include "value.hpp"

namespace asperity::python {

namespace {

thread_local int calls = 0;  // of classes, now running in this thread
newfunc plain_new = nullptr;
ternaryfunc plain_call = nullptr;

PyObject* called(PyObject* cls, PyObject* args, PyObject* kwargs) {
  ++calls;
  PyObject* const made = plain_call(cls, args, kwargs);
  --calls;
  return made;
}

PyObject* made(PyTypeObject* cls, PyObject* args, PyObject* kwargs) {
  if (calls > 0) return plain_new(cls, args, kwargs);
  return PyErr_Format(PyExc_TypeError, "%s: is made by calling it, not by __new__", cls->tp_name);
}

/// pybind11's metaclass, but that its calls are counted.
PyTypeObject* metaclass(PyTypeObject* of) {
  static PyTypeObject* const counting = [&] {
    const py::handle type(reinterpret_cast<PyObject*>(&PyType_Type)), base(reinterpret_cast<PyObject*>(of));
    py::dict members;
    members["__slots__"] = py::tuple();
    auto* const result =
        reinterpret_cast<PyTypeObject*>(type("asperity_type", py::make_tuple(base), members).release().ptr());
    plain_call = of->tp_call;
    result->tp_call = &called;
    result->tp_dealloc = of->tp_dealloc;  // which forgets the class
    return result;
  }();
  return counting;
}

}  // namespace

void made_by_call_alone(py::handle cls) {
  auto* const type = reinterpret_cast<PyTypeObject*>(cls.ptr());
  PyTypeObject* const counting = metaclass(Py_TYPE(cls.ptr()));
  Py_INCREF(counting);
  Py_SET_TYPE(cls.ptr(), counting);
  if (type->tp_new != &made) plain_new = type->tp_new;
  type->tp_new = &made;
  PyType_Modified(type);
}

}  // namespace asperity::python
