"""Many scenes at once: axes over their keys, tasks for any executor, stores to be resumed."""
