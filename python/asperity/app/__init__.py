"""The app in the browser: a scene that is edited by controls, and what is computed of it.

Its page is NiceGUI's: that serves every file of its own, so that nothing is asked from outside; its
page stays open over one WebSocket, so that a curve is sent as soon as it is known, where frameworks
that run a script anew for each change compute all of it again; and it runs inside of an ASGI
application, before which the guard can stand.
"""
