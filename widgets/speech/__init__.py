"""What is said: recordings, their words, the voice, phone names, the microphone."""
