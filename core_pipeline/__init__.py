"""The domain: from phones and curves to pose weights and deformed faces. numpy and scipy, no Qt."""
