"""What every public object is made of: values, checked arguments, tables."""
