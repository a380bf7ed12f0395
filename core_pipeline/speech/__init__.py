"""From text and sound to an Utterance: phones with times, the words, and the audio."""
