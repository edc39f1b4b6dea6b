"""The app in the browser: a scene that is edited by controls, and what is computed of it."""
