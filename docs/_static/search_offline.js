// Excerpts of the pages that a search finds are fetched, which browsers refuse for files: there the list has titles alone.
if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;
