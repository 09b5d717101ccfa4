"""The sample recordings that come with the project, made from the conversations written here.

``python -m mmsverify.samples FOLDER`` writes them: the same octets every time. What stands here
speaks MMS as a client and a robot would; nothing reads a model, so that a sample is a witness of its own and
not the model's echo.
"""
