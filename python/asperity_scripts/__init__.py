"""Scripts behind verbs of the shell, which no other part of the library needs: the article remade,
and corrections held against exact contact. They are installed with the library."""
